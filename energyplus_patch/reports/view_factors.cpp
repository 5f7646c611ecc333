#include "reports/view_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "model/idf/local_environment.h"
#include "model/input/surrounding_groups.h"
#include "reports/map_grid.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int million = 1'000'000;

// The additive recurrence in four dimensions (Roberts, 2018): the multiples of the powers of the
// inverse of the root of x^5 = x + 1.
class Sequence {
 public:
  // Shifted by a number of the same sequence in one dimension.
  explicit Sequence(int batch) : shift_(fraction(0.5 + (batch + 1) * (std::numbers::phi - 1.0))) {}

  double at(int index, int dimension) const {
    constexpr std::array<double, 4> steps{0.8566748838545029, 0.733891856627126, 0.6287067210378086,
                                          0.53859725722361};
    auto const place = static_cast<std::size_t>(dimension);
    return fraction(shift_ * (dimension + 1) + index * steps.at(place));
  }

 private:
  static double fraction(double value) { return value - std::floor(value); }

  double shift_;
};

struct Tangents {
  glm::dvec3 u;
  glm::dvec3 v;
};

Tangents tangents_of(glm::dvec3 const& normal) {
  constexpr double upright = 0.9;
  glm::dvec3 const other =
      std::abs(normal.z) < upright ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  auto const u = glm::normalize(glm::cross(other, normal));
  return {u, glm::cross(normal, u)};
}

// The rays of one batch, from points that are spread by area.
std::vector<Ray> rays_of(MaskPoints const& points, std::vector<double> const& up_to, int batch,
                         int count) {
  Sequence const sequence(batch);
  auto const [u, v] = tangents_of(points.normal);
  auto const lift = points.normal * ray_lift;
  std::vector<Ray> rays;
  rays.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    double const square = sequence.at(i, 0);
    double const angle = 2.0 * std::numbers::pi * sequence.at(i, 1);
    double const across = std::sqrt(square);
    auto const found = std::lower_bound(up_to.begin(), up_to.end() - 1, sequence.at(i, 2));
    auto const& turns = points.points[static_cast<std::size_t>(found - up_to.begin())];
    auto const turn = static_cast<std::size_t>(sequence.at(i, 3) * double(turns.size()));
    rays.push_back({turns[std::min(turn, turns.size() - 1)] + lift,
                    across * std::cos(angle) * u + across * std::sin(angle) * v +
                        std::sqrt(1.0 - square) * points.normal});
  }
  return rays;
}

// One group of a list of surfaces.
struct Item {
  ViewedGroup const& group;
  int millionths;
};

double factor_of(int millionths) { return static_cast<double>(millionths) / million; }

void add_surrounding(ModelEditor& editor, std::string const& name, int sky,
                     std::vector<Item> const& groups) {
  std::vector<std::vector<NewField>> items;
  items.reserve(groups.size());
  for (auto const& [group, millionths] : groups) {
    items.push_back({{"surrounding_surface_name", group.name},
                     {"surrounding_surface_view_factor", factor_of(millionths)},
                     {"surrounding_surface_temperature_schedule_name", group.schedule}});
  }
  editor.add({"SurfaceProperty:SurroundingSurfaces",
              {{"name", name},
               {"sky_view_factor", factor_of(sky)},
               {"sky_temperature_schedule_name", ""},
               {"ground_view_factor", 0.0},
               {"ground_temperature_schedule_name", ""}},
              "surfaces",
              std::move(items)});
}

}  // namespace

ViewFactors trace_view_factors(RayScene const& scene, RayConditions const& conditions,
                               std::span<std::size_t const> group_of, std::size_t groups,
                               MaskPoints const& points, int rays) {
  std::vector<double> up_to(points.shares.size());
  std::partial_sum(points.shares.begin(), points.shares.end(), up_to.begin());
  int const count = rays / view_factor_batches;
  std::vector<double> sums(groups, 0.0);
  std::vector<double> squares(groups, 0.0);
  std::vector<std::vector<RayLayer>> layers(static_cast<std::size_t>(count));
  for (int batch = 0; batch < view_factor_batches; ++batch) {
    auto const lines = rays_of(points, up_to, batch, count);
    scene.layers(lines, conditions, layers);
    std::vector<double> shares(groups, 0.0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double passed = 1.0;
      for (auto const& layer : layers[i]) {
        shares[group_of[layer.surface]] += passed * (1.0 - layer.transmittance);
        passed *= layer.transmittance;
      }
      shares[lines[i].direction.z > 0.0 ? viewed_sky : viewed_ground] += passed;
    }
    for (std::size_t k = 0; k < groups; ++k) {
      double const share = shares[k] / count;
      sums[k] += share;
      squares[k] += share * share;
    }
  }
  ViewFactors result;
  for (std::size_t k = 0; k < groups; ++k) {
    double const mean = sums[k] / view_factor_batches;
    double const variance = std::max(0.0, squares[k] / view_factor_batches - mean * mean);
    result.factors.push_back(mean);
    result.error = std::max(result.error, std::sqrt(variance / (view_factor_batches - 1)));
  }
  return result;
}

std::vector<int> in_millionths(std::vector<double> const& factors) {
  std::vector<int> rounded;
  int rest = million;
  for (double const factor : factors) {
    rounded.push_back(static_cast<int>(std::lround(factor * million)));
    rest -= rounded.back();
  }
  *std::ranges::max_element(rounded) += rest;
  return rounded;
}

std::vector<std::string> add_local_environments(ModelEditor& editor,
                                                std::vector<ViewedGroup> const& groups,
                                                std::vector<SurfaceViews> const& views) {
  std::vector<std::string> cut_off;
  for (auto const& [surface, millionths, sky_ratio] : views) {
    std::vector<Item> scheduled;
    int seen = 0;
    double sum = 0.0;
    for (std::size_t k = viewed_ground; k < groups.size(); ++k) {
      if (millionths[k] == 0 || groups[k].schedule.empty()) continue;
      scheduled.push_back({groups[k], millionths[k]});
      seen += millionths[k];
      sum += factor_of(millionths[k]);
    }
    double const wanted = millionths[viewed_sky] / std::max(sky_ratio, 1e-6);
    int sky = static_cast<int>(std::lround(std::min(wanted, double{million} - seen)));
    constexpr double negligible = 0.01 * million;
    if ((wanted - sky) * sky_ratio > negligible) cut_off.push_back(surface);
    // EnergyPlus refuses a sum that is more than 1 by rounding.
    if (sky > 0 && factor_of(sky) + sum > 1.0) --sky;
    auto const name = std::string(views_of) + surface;
    if (scheduled.empty()) {
      editor.add(ground_object(name, {.view = factor_of(million - sky)}));
    } else {
      add_surrounding(editor, name, sky, scheduled);
    }
    editor.add(environment_object({.name = name,
                                   .surface = surface,
                                   .surroundings = scheduled.empty() ? "" : name,
                                   .ground = scheduled.empty() ? name : ""}));
  }
  return cut_off;
}

}  // namespace gpu_shading::energyplus
