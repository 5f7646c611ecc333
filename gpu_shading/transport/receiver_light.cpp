#include "transport/receiver_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "platform/parallel.h"
#include "transport/hit_pool.h"

namespace gpu_shading {
namespace {

constexpr std::size_t paths_of_replicate = 1024;
constexpr int draws_of_replicate = 16;  // shadow rays for a sun
// Draws of the sun for each of a mirrored one: glass reflects little.
constexpr int straight_for_mirrored = 4;
constexpr std::size_t least_replicates = 4;
constexpr std::size_t most_replicates = 1024;
constexpr std::size_t direct_rays = 8;  // from the receiver to a sun of the first table

struct Grid {
  int declinations;
  double step;  // degrees
};

constexpr std::array<Grid, 4> grids{{{9, 7.5}, {17, 5.0}, {25, 3.75}, {49, 1.875}}};

SunTable table_of(double latitude, Grid const& grid) {
  return {latitude, grid.declinations, glm::radians(grid.step)};
}

struct Receiver {
  SurfaceId id;
  std::uint32_t seed;
  ReceiverPoints points;
};

SobolPoints const& sobol_points() {
  static SobolPoints const points(paths_of_replicate, path_dimensions);
  return points;
}

// Irradiance for a beam of 1 W/m2 by sun of the table, straight. Adds up its rays.
std::vector<double> direct_beam(LightRequest const& request, Receiver const& receiver,
                                SunTable const& table, std::size_t& rays) {
  auto conditions = request.conditions;
  conditions.receiver = receiver.id;
  std::vector<double> direct;
  for (auto const& sun : table.suns()) {
    double const cosine = glm::dot(sun, receiver.points.normal());
    double passed = 0.0;
    for (std::size_t i = 0; i < direct_rays && cosine > 0.0; ++i) {
      auto const point = rays++ % paths_of_replicate;
      auto const coordinate = [&](std::size_t dimension) {
        return sobol_points().at(point, dimension, receiver.seed);
      };
      Ray ray{receiver.points.at(coordinate(0), coordinate(1)), sun};
      ray.from = receiver.id;
      passed += request.scene.rays.transmittance(ray, conditions);
    }
    direct.push_back(std::max(0.0, cosine) * passed / direct_rays);
  }
  return direct;
}

ReceiverHours hours_of(LightRequest const& request, Receiver const& receiver, std::size_t& rays) {
  auto const table = table_of(request.transport.latitude, grids.front());
  auto const direct = direct_beam(request, receiver, table, rays);
  ReceiverHours hours;
  auto const& normal = receiver.points.normal();
  for (std::size_t h = 0; h < request.year.hours.size(); ++h) {
    auto const& hour = request.year.hours[h];
    hours.direct.push_back(table.at(direct, hour.sun));
    double const open = hour.beam * std::max(0.0, glm::dot(request.year.suns[h], normal)) +
                        hour.diffuse * 0.5 * (1.0 + normal.z);
    hours.least.push_back(request.transport.floor * open);
  }
  hours.probes = choose_probes(request.year, hours);
  return hours;
}

// The suns of a table, and where each hour lies among them.
struct Positions {
  Positions(TransportRequest const& request, SolarHours const& year, Grid const& grid)
      : table(table_of(request.latitude, grid)) {
    hours.reserve(year.hours.size());
    for (auto const& hour : year.hours) hours.push_back(table.around(hour.sun));
  }

  SunTable table;
  std::vector<std::array<SunTable::Corner, 4>> hours;
};

// Where the sun's light is last reflected diffusely before it reaches the receiver.
class LitPlaces {
 public:
  LitPlaces(LightRequest const& request, Receiver const& receiver, std::vector<KeptHit> hits,
            std::uint32_t seed)
      : request_(request),
        receiver_(receiver.id),
        conditions_(request.conditions),
        pool_(with_receiver(request, receiver, std::move(hits), seed), paths_of_replicate,
              receiver.points.at(0.5, 0.5),
              std::sqrt(area(request.scene.scene[receiver.id].polygon))) {
    conditions_.receiver = std::nullopt;
  }

  // Of a beam of 1 W/m2. Adds up its rays.
  LightByGround beam(glm::dvec3 const& sun, std::uint64_t key, std::size_t& rays) const {
    auto const& scene = request_.scene;
    LightByGround light;
    std::array const straight{LightDirection{sun}};
    for (auto const& [hit, direction, weight] : pool_.draw(straight, draws_of_replicate, key)) {
      Ray ray{hit->point, sun};
      ray.from = hit->surface;
      part_of(light, hit->by_ground) += weight * scene.rays.transmittance(ray, conditions_);
      ++rays;
    }
    auto const images = scene.mirrors.images(sun);
    for (auto const& [hit, image, weight] :
         pool_.draw(images, draws_of_replicate / straight_for_mirrored, ~key)) {
      Ray ray{hit->point, images[image].towards};
      ray.from = hit->surface;
      auto conditions = conditions_;
      if (hit->on_receiver) conditions.receiver = receiver_;
      part_of(light, hit->by_ground) +=
          weight * scene.mirrors.reflected(scene.rays, conditions, ray, image, sun, rays);
    }
    return light;
  }

 private:
  // Places on the receiver itself are lit by mirrors.
  static std::vector<KeptHit> with_receiver(LightRequest const& request, Receiver const& receiver,
                                            std::vector<KeptHit> hits, std::uint32_t seed) {
    for (std::size_t i = 0; i < paths_of_replicate && !request.scene.mirrors.empty(); ++i) {
      auto const point =
          receiver.points.at(sobol_points().at(i, 0, seed), sobol_points().at(i, 1, seed));
      hits.push_back({point, receiver.points.normal(), 1.0, receiver.id, 0, true});
    }
    return hits;
  }

  LightRequest const& request_;
  SurfaceId receiver_;
  RayConditions conditions_;
  HitPool pool_;
};

Replicate replicate_of(LightRequest const& request, Receiver const& receiver,
                       Positions const& positions, std::vector<Probe> const& probes,
                       std::uint32_t seed) {
  auto paths = trace_paths(request.scene, receiver.id, receiver.points, sobol_points(), seed,
                           request.conditions);
  Replicate replicate;
  replicate.sky = paths.sky;
  replicate.sky_direct = paths.sky_direct;
  replicate.rays = paths.rays;
  LitPlaces const places(request, receiver, std::move(paths.hits), seed);
  std::uint64_t key = std::uint64_t{seed} << 32U;
  auto const ask = [&](glm::dvec3 const& sun) { return places.beam(sun, ++key, replicate.rays); };
  for (auto const& sun : positions.table.suns()) replicate.beam.push_back(ask(sun));
  replicate.hourly.reserve(positions.hours.size());
  for (auto const& corners : positions.hours) {
    double sum = 0.0;
    for (auto const& corner : corners) sum += corner.share * replicate.beam[corner.sun].sum();
    replicate.hourly.push_back(sum);
  }
  for (auto const& probe : probes) {
    replicate.gaps.push_back(ask(request.year.suns[probe.hour]).sum() -
                             replicate.hourly[probe.hour]);
  }
  for (auto const& light : request.transport.lights) replicate.lights.push_back(ask(light));
  return replicate;
}

bool are_small(Errors const& errors, std::size_t replicates, TransportRequest const& request) {
  // Student's t for few replicates, one-sided 84 %.
  double const t = 1.0 + 2.5 / double(replicates);
  return std::hypot(t * errors.noise, errors.interpolation) < request.hourly &&
         std::hypot(t * errors.annual_noise, errors.annual_interpolation) < request.annual;
}

Transported mean_of(std::vector<Replicate> const& replicates, SunTable const& table,
                    Errors const& errors) {
  Transported mean{table};
  mean.beam.resize(table.suns().size());
  mean.lights.resize(replicates.front().lights.size());
  auto const share = 1.0 / double(replicates.size());
  for (auto const& replicate : replicates) {
    for (std::size_t i = 0; i < mean.beam.size(); ++i) mean.beam[i] += share * replicate.beam[i];
    for (std::size_t i = 0; i < mean.lights.size(); ++i) {
      mean.lights[i] += share * replicate.lights[i];
    }
    mean.sky += share * replicate.sky;
    mean.sky_direct += share * replicate.sky_direct;
  }
  mean.noise = errors.noise;
  mean.annual_noise = errors.annual_noise;
  mean.interpolation = errors.interpolation;
  mean.annual_interpolation = errors.annual_interpolation;
  return mean;
}

}  // namespace

Transported light_on(LightRequest const& request, SurfaceId id, std::uint32_t seed) {
  constexpr std::uint32_t far_apart = 0x9e3779b9U;  // seeds of receivers
  Receiver const receiver{id, seed * far_apart, ReceiverPoints(request.scene.scene[id].polygon)};
  if (receiver.points.empty()) {
    auto const table = table_of(request.transport.latitude, grids.front());
    return {table, std::vector<LightByGround>(table.suns().size()),
            std::vector<LightByGround>(request.transport.lights.size())};
  }
  std::size_t rays = 0;
  auto const hours = hours_of(request, receiver, rays);
  std::uint32_t next = receiver.seed;
  for (std::size_t g = 0;; ++g) {
    Positions const positions(request.transport, request.year, grids.at(g));
    std::vector<Replicate> replicates;
    while (true) {
      auto const first = replicates.size();
      replicates.resize(std::max(least_replicates, first + 1 + first / 8));
      for_each_index(replicates.size() - first, [&](std::size_t i) {
        replicates[first + i] = replicate_of(request, receiver, positions, hours.probes,
                                             next + static_cast<std::uint32_t>(first + i));
      });
      for (auto i = first; i < replicates.size(); ++i) rays += replicates[i].rays;
      auto const errors = errors_of(replicates, request.year, hours, request.transport);
      if (are_small(errors, replicates.size(), request.transport) ||
          replicates.size() >= most_replicates || rays >= request.transport.most_rays) {
        auto light = mean_of(replicates, positions.table, errors);
        light.rays = rays;
        return light;
      }
      if (errors.needs_finer_table && g + 1 < grids.size()) break;
    }
    next += most_replicates;
  }
}

}  // namespace gpu_shading
