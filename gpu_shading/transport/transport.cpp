#include "gpu_shading/transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/parallel.h"
#include "transport/hit_pool.h"
#include "transport/reverse_paths.h"

namespace gpu_shading {
namespace {

constexpr std::size_t paths_of_replicate = 1024;
constexpr int draws = 32;  // shadow rays for a sun, in a replicate
constexpr std::size_t least_replicates = 4;
constexpr std::size_t most_replicates = 64;
constexpr std::size_t direct_rays = 8;  // from the receiver to a sun of the first table
constexpr int probes = 48;              // true suns, for the error of interpolation

struct Grid {
  int declinations;
  double step;  // degrees
};

constexpr std::array<Grid, 3> grids{{{9, 7.5}, {25, 3.75}, {49, 1.875}}};

SunTable table_of(double latitude, Grid const& grid) {
  return {latitude, grid.declinations, glm::radians(grid.step)};
}

double square(double x) { return x * x; }

// Hours with sun, and what errors are relative to.
struct Year {
  std::vector<TransportHour> hours;
  std::vector<double> direct;       // of the beam, without a reflection, by hour
  std::vector<double> least;        // W/m2, by hour
  std::vector<std::size_t> probed;  // hours, spread by their beam
  std::vector<glm::dvec3> suns;     // of those
  double beam = 0.0;                // of all hours
};

Year year_of(TransportRequest const& request, glm::dvec3 const& normal) {
  Year year;
  std::vector<glm::dvec3> suns;
  std::vector<double> up_to;
  for (auto const& hour : request.hours) {
    auto const sun = to_vector(to_direction(hour.sun, request.latitude));
    if (sun.z <= 0.0 || hour.beam + hour.diffuse <= 0.0) continue;
    double const open =
        hour.beam * std::max(0.0, glm::dot(sun, normal)) + hour.diffuse * 0.5 * (1.0 + normal.z);
    year.hours.push_back(hour);
    year.least.push_back(request.floor * open);
    suns.push_back(sun);
    up_to.push_back(year.beam += hour.beam);
  }
  for (int i = 0; i < probes && year.beam > 0.0; ++i) {
    double const place = (i + 0.5) / probes * year.beam;
    auto const found = std::upper_bound(up_to.begin(), std::prev(up_to.end()), place);
    auto const hour = static_cast<std::size_t>(found - up_to.begin());
    if (!year.probed.empty() && year.probed.back() == hour) continue;
    year.probed.push_back(hour);
    year.suns.push_back(suns[hour]);
  }
  return year;
}

// One of several independent answers.
struct Replicate {
  std::vector<LightByGround> beam;  // by sun of the table
  std::vector<double> hourly;       // of the table, by hour of the year
  std::vector<double> gaps;         // of the probes' own answers to the table's
  LightByGround sky;
  double sky_direct = 0.0;
  std::size_t rays = 0;
};

struct Question {
  TransportScene const& scene;
  SurfaceId receiver;
  ReceiverPoints const& places;
  SobolPoints const& points;
  RayConditions const& conditions;
  Year const& year;
};

Replicate replicate_of(Question const& question, SunTable const& table, std::uint32_t seed) {
  auto const& scene = question.scene;
  auto paths = trace_paths(scene, question.receiver, question.places, question.points, seed,
                           question.conditions);
  Replicate replicate;
  replicate.sky = paths.sky;
  replicate.sky_direct = paths.sky_direct;
  replicate.rays = paths.rays;
  double const size = std::sqrt(area(scene.scene[question.receiver].polygon));
  HitPool const pool(std::move(paths.hits), question.points.count(), question.places.at(0.5, 0.5),
                     size);
  auto conditions = question.conditions;
  conditions.receiver = std::nullopt;
  std::uint64_t key = std::uint64_t{seed} << 32U;
  auto const ask = [&](glm::dvec3 const& sun) {
    auto const beam = pool.beam(scene.rays, conditions, sun, draws, ++key);
    replicate.rays += beam.rays;
    return beam;
  };
  for (auto const& sun : table.suns()) {
    auto const beam = ask(sun);
    replicate.beam.push_back(beam.light);
  }
  for (auto const& hour : question.year.hours) {
    double sum = 0.0;
    for (auto const& corner : table.around(hour.sun)) {
      sum += corner.share * replicate.beam[corner.sun].sum();
    }
    replicate.hourly.push_back(sum);
  }
  for (std::size_t i = 0; i < question.year.probed.size(); ++i) {
    replicate.gaps.push_back(ask(question.year.suns[i]).light.sum() -
                             replicate.hourly[question.year.probed[i]]);
  }
  return replicate;
}

struct DirectBeam {
  std::vector<double> irradiance;  // for a beam of 1 W/m2, by sun
  std::size_t rays = 0;
};

DirectBeam direct_beam(Question const& question, SunTable const& table, std::uint32_t seed) {
  auto conditions = question.conditions;
  conditions.receiver = question.receiver;
  DirectBeam direct;
  for (auto const& sun : table.suns()) {
    double const cosine = glm::dot(sun, question.places.normal());
    double passed = 0.0;
    for (std::size_t i = 0; i < direct_rays && cosine > 0.0; ++i) {
      auto const point = direct.rays++ % question.points.count();
      auto const coordinate = [&](std::size_t of) { return question.points.at(point, of, seed); };
      Ray ray{question.places.at(coordinate(0), coordinate(1)), sun};
      ray.from = question.receiver;
      passed += question.scene.rays.transmittance(ray, conditions);
    }
    direct.irradiance.push_back(std::max(0.0, cosine) * passed / direct_rays);
  }
  return direct;
}

struct Errors {
  double noise = 0.0;
  double annual_noise = 0.0;
  double interpolation = 0.0;
  bool needs_finer_table = false;
};

double mean_sky(std::span<Replicate const> replicates) {
  double sum = 0.0;
  for (auto const& replicate : replicates) sum += replicate.sky.sum();
  return sum / double(replicates.size());
}

double mean_hour(std::span<Replicate const> replicates, std::size_t hour) {
  double sum = 0.0;
  for (auto const& replicate : replicates) sum += replicate.hourly[hour];
  return sum / double(replicates.size());
}

// From the spread of the replicates. Products of gaps of different replicates have no noise of
// their own: their mean is the square of the interpolation's error.
Errors errors_of(std::span<Replicate const> replicates, Year const& year, double hourly_target) {
  auto const count = double(replicates.size());
  double const sky = mean_sky(replicates);
  double sky_direct = 0.0;
  for (auto const& replicate : replicates) sky_direct += replicate.sky_direct / count;
  std::vector<double> totals;
  std::vector<double> sums(replicates.size(), 0.0);  // of differences from the mean
  double all = 0.0;
  double squares = 0.0;
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    auto const& hour = year.hours[h];
    double const mean = mean_hour(replicates, h);
    double const total = std::max(
        hour.beam * (mean + year.direct[h]) + hour.diffuse * (sky + sky_direct), year.least[h]);
    totals.push_back(total);
    if (total <= 0.0) continue;
    all += total;
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      double const off = hour.beam * (replicates[r].hourly[h] - mean) +
                         hour.diffuse * (replicates[r].sky.sum() - sky);
      sums[r] += off;
      squares += square(off) / total;
    }
  }
  Errors errors;
  if (all <= 0.0) return errors;
  double const freedom = count * (count - 1.0);
  errors.noise = std::sqrt(squares / freedom / all);
  double of_sums = 0.0;
  for (double const sum : sums) of_sums += square(sum);
  errors.annual_noise = std::sqrt(of_sums / freedom) / all;

  std::vector<double> biases;
  for (std::size_t i = 0; i < year.probed.size(); ++i) {
    double sum = 0.0;
    double own = 0.0;
    for (auto const& replicate : replicates) {
      sum += replicate.gaps[i];
      own += square(replicate.gaps[i]);
    }
    auto const h = year.probed[i];
    biases.push_back(year.hours[h].beam * (square(sum) - own) / freedom /
                     std::max(totals[h], 1e-9) * year.beam / all);
  }
  if (biases.empty()) return errors;
  double const probes_count = double(biases.size());
  double const mean = std::accumulate(biases.begin(), biases.end(), 0.0) / probes_count;
  double variance = 0.0;
  for (double const bias : biases) variance += square(bias - mean) / probes_count;
  errors.interpolation = std::sqrt(std::max(0.0, mean));
  bool const sure = mean - 2.0 * std::sqrt(variance / probes_count) > 0.5 * square(hourly_target);
  errors.needs_finer_table =
      sure || errors.interpolation > std::max(0.7 * hourly_target, 2.0 * errors.noise);
  return errors;
}

bool are_small(Errors const& errors, std::size_t replicates, TransportRequest const& request) {
  // Student's t for few replicates, one-sided 84 %.
  double const t = 1.0 + 2.5 / double(replicates);
  return t * std::hypot(errors.noise, errors.interpolation) < request.hourly &&
         t * errors.annual_noise < request.annual;
}

Transported mean_of(std::span<Replicate const> replicates, SunTable table, Errors const& errors) {
  Transported mean{std::move(table)};
  mean.beam.resize(mean.table.suns().size());
  auto const share = 1.0 / double(replicates.size());
  for (auto const& replicate : replicates) {
    for (std::size_t i = 0; i < mean.beam.size(); ++i) mean.beam[i] += share * replicate.beam[i];
    mean.sky += share * replicate.sky;
    mean.sky_direct += share * replicate.sky_direct;
  }
  mean.noise = errors.noise;
  mean.annual_noise = errors.annual_noise;
  mean.interpolation = errors.interpolation;
  return mean;
}

void require_share(double value, SurfaceId surface) {
  if (!(value >= 0.0 && value <= 1.0)) {
    throw Error(
        fmt::format("the reflectance of surface {} is {}; expected 0 to 1", surface, value));
  }
}

}  // namespace

Transport::Transport(Scene const& scene, RayScene const& rays,
                     std::vector<FaceReflectances> reflectances,
                     std::optional<ReflectingGround> ground)
    : scene_(scene), rays_(rays), reflectances_(std::move(reflectances)), ground_(ground) {
  if (reflectances_.size() != scene.size()) {
    throw Error(fmt::format("there are {} reflectances; expected {}, one for each surface",
                            reflectances_.size(), scene.size()));
  }
  normals_.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    require_share(reflectances_[id].front, id);
    require_share(reflectances_[id].back, id);
    normals_.push_back(normal(scene[id].polygon));
  }
}

Transported Transport::to(SurfaceId receiver, TransportRequest const& request,
                          RayConditions const& conditions, std::uint32_t seed) const {
  static SobolPoints const points(paths_of_replicate, path_dimensions);
  ReceiverPoints const places(scene_[receiver].polygon);
  auto const first_table = table_of(request.latitude, grids.front());
  if (places.empty()) return {first_table, std::vector<LightByGround>(first_table.suns().size())};
  auto year = year_of(request, places.normal());
  TransportScene const scene{scene_, rays_, normals_, reflectances_, ground_};
  Question const question{scene, receiver, places, points, conditions, year};
  std::uint32_t next = seed * 0x9e3779b9U;  // seeds of receivers are far apart
  auto const direct = direct_beam(question, first_table, next);
  for (auto const& hour : year.hours) {
    year.direct.push_back(first_table.at(direct.irradiance, hour.sun));
  }
  std::size_t rays = direct.rays;
  for (std::size_t g = 0;; ++g) {
    auto const table = table_of(request.latitude, grids.at(g));
    std::vector<Replicate> replicates;
    while (true) {
      std::size_t const more = std::max(least_replicates, replicates.size()) - replicates.size();
      auto const first = replicates.size();
      replicates.resize(first + std::max<std::size_t>(more, 1));
      for_each_index(replicates.size() - first, [&](std::size_t i) {
        replicates[first + i] =
            replicate_of(question, table, next + static_cast<std::uint32_t>(first + i));
      });
      for (auto i = first; i < replicates.size(); ++i) rays += replicates[i].rays;
      auto const errors = errors_of(replicates, year, request.hourly);
      bool const ends = are_small(errors, replicates.size(), request) ||
                        replicates.size() >= most_replicates || rays >= request.most_rays;
      bool const refines = !ends && errors.needs_finer_table && g + 1 < grids.size();
      if (refines) break;
      if (ends) {
        auto result = mean_of(replicates, table, errors);
        result.rays = rays;
        return result;
      }
    }
    next += most_replicates;
  }
}

std::vector<Transported> Transport::to(std::span<SurfaceId const> receivers,
                                       TransportRequest const& request,
                                       RayConditions const& conditions) const {
  std::vector<std::optional<Transported>> found(receivers.size());
  for_each_index(receivers.size(), [&](std::size_t i) {
    found[i] = to(receivers[i], request, conditions, static_cast<std::uint32_t>(receivers[i]));
  });
  std::vector<Transported> lights;
  lights.reserve(found.size());
  for (auto& light : found) lights.push_back(std::move(*light));
  return lights;
}

}  // namespace gpu_shading
