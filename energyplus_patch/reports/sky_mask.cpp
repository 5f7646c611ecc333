#include "reports/sky_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "model/extensions/extension_fields.h"
#include "reports/map_grid.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {
namespace {

ShadeKind kind_of_caster(std::string const& type, std::string const& name) {
  if (type == extension::geometry::type) return ShadeKind::geometry;
  if (type == extension::tree::type) return ShadeKind::trees;
  return name.ends_with(":TERRAIN") ? ShadeKind::terrain : ShadeKind::neighbours;
}

ShadeKind kind_of(ShadingInput const& input, std::string const& name) {
  auto found = input.shading_surfaces.find(name);
  if (found == input.shading_surfaces.end() && is_mirrored(name)) {
    found = input.shading_surfaces.find(name.substr(mirrored_name("").size()));
  }
  if (found == input.shading_surfaces.end()) return ShadeKind::building;
  return found->second.type.starts_with("Shading:Site") ? ShadeKind::neighbours : ShadeKind::shades;
}

bool is_stopped(BeamShare const& share) { return share.faced && share.sunlit <= 0.5F; }

// What becomes of a ray's beam.
void add_ray(BeamShare& share, std::vector<RayLayer> const& layers,
             std::vector<ShadeKind> const& kinds, double weight) {
  double passed = weight;
  for (auto const& layer : layers) {
    share.stopped.at(static_cast<std::size_t>(kinds[layer.surface])) +=
        static_cast<float>(passed * (1.0 - layer.transmittance));
    passed *= layer.transmittance;
  }
  share.sunlit += static_cast<float>(passed);
}

}  // namespace

std::string_view name_of(ShadeKind kind) {
  constexpr std::array<std::string_view, shade_kinds> names{"building", "shades",     "geometry",
                                                            "trees",    "neighbours", "terrain"};
  return names.at(static_cast<std::size_t>(kind));
}

std::vector<ShadeKind> kinds_of(SceneAssembly const& assembly, Scene const& scene) {
  auto const& model = assembly.model();
  std::vector<ShadeKind> kinds;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& name = scene[id].name;
    auto const type = model.surroundings.types.find(name);
    bool const outside = id >= assembly.size() && type != model.surroundings.types.end();
    kinds.push_back(outside ? kind_of_caster(type->second, name) : kind_of(model.shading, name));
  }
  return kinds;
}

void set_sunlit(BeamShare& share, double fraction) {
  if (!share.faced) return;
  float const before = 1.0F - share.sunlit;
  share.sunlit = static_cast<float>(fraction);
  if (before <= 0.0F) return;
  for (auto& stopped : share.stopped) stopped *= (1.0F - share.sunlit) / before;
}

std::vector<SunDirection> SkyGrid::directions() const {
  std::vector<SunDirection> all;
  all.reserve(size());
  for (std::size_t row = 0; row < rows(); ++row) {
    for (std::size_t column = 0; column < columns(); ++column) {
      all.push_back({glm::radians((static_cast<double>(column) + 0.5) * step_),
                     glm::radians((static_cast<double>(row) + 0.5) * step_)});
    }
  }
  return all;
}

double SkyGrid::solid_angle(std::size_t row) const {
  double const low = glm::radians(static_cast<double>(row) * step_);
  return glm::radians(double(step_)) *
         (std::sin(low + glm::radians(double(step_))) - std::sin(low));
}

MaskPoints points_of(Polygon const& polygon, int rays) {
  constexpr double widest = 1e9;
  auto const whole = MapGrid(polygon, widest).cell_size();
  auto const columns =
      std::clamp(std::round(std::sqrt(rays * whole.x / whole.y)), 1.0, static_cast<double>(rays));
  double const rows = std::max(1.0, std::round(rays / columns));
  double const rounding = 1.0 + 1e-9;
  MapGrid const grid(polygon, std::max(whole.x / columns, whole.y / rows) * rounding);
  MaskPoints points;
  points.normal = grid.axes().normal;
  double area = 0.0;
  for (auto const& cell : grid.cells()) {
    area += cell.area;
    points.shares.push_back(cell.area);
    constexpr std::size_t turns = 64;
    auto& own = points.points.emplace_back();
    for (std::size_t i = 0; i < turns; ++i) own.push_back(grid.point(cell, i));
  }
  for (auto& share : points.shares) share /= area;
  return points;
}

MaskPoints point_at(glm::dvec3 const& point, glm::dvec3 const& normal) {
  return {normal, {{point}}, {1.0}};
}

std::vector<BeamShare> trace_shares(RayScene const& rays, RayConditions const& conditions,
                                    std::vector<ShadeKind> const& kinds, MaskPoints const& points,
                                    std::span<SunDirection const> directions) {
  std::vector<BeamShare> shares(directions.size());
  std::vector<Ray> batch;
  std::vector<std::pair<std::size_t, std::size_t>> origins;  // direction and cell of each ray
  std::vector<std::vector<RayLayer>> layers;
  auto const trace = [&] {
    layers.resize(batch.size());
    rays.layers(batch, conditions, layers);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      auto const [direction, cell] = origins[i];
      add_ray(shares[direction], layers[i], kinds, points.shares[cell]);
    }
    batch.clear();
    origins.clear();
  };
  auto const start = points.normal * ray_lift;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    auto const towards = to_vector(directions[i]);
    if (glm::dot(towards, points.normal) < min_cosine) continue;
    shares[i].faced = true;
    for (std::size_t cell = 0; cell < points.points.size(); ++cell) {
      constexpr std::size_t from_cell_to_cell = 37;
      auto const& turns = points.points[cell];
      batch.push_back({turns[(i + from_cell_to_cell * cell) % turns.size()] + start, towards});
      origins.emplace_back(i, cell);
    }
    if (batch.size() >= rays_in_batch) trace();
  }
  trace();
  return shares;
}

SkyView sky_view(SkyGrid const& grid, std::span<BeamShare const> shares, glm::dvec3 const& normal) {
  SkyView sums;
  auto const directions = grid.directions();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!shares[i].faced) continue;
    double const weight =
        grid.solid_angle(i / grid.columns()) * glm::dot(to_vector(directions[i]), normal);
    sums.unshaded += weight;
    sums.view += weight * double{shares[i].sunlit};
    for (std::size_t k = 0; k < shade_kinds; ++k) {
      sums.stopped.at(k) += weight * double{shares[i].stopped.at(k)};
    }
  }
  if (sums.unshaded <= 0.0) return {};
  // By shares of the unshaded view, so that cells cut by the receiver's plane do not matter.
  double const unshaded = (1.0 + normal.z) / 2.0;
  double const scale = unshaded / sums.unshaded;
  sums.unshaded = unshaded;
  sums.view *= scale;
  for (auto& stopped : sums.stopped) stopped *= scale;
  return sums;
}

std::vector<double> trace_horizon(RayScene const& rays, RayConditions const& conditions,
                                  std::vector<ShadeKind> const& kinds, MaskPoints const& points,
                                  SkyGrid const& grid, std::span<BeamShare const> shares) {
  auto const directions = grid.directions();
  std::vector<double> low(grid.columns());   // radians: stopped, or the level
  std::vector<double> high(grid.columns());  // clear, or the zenith
  for (std::size_t column = 0; column < grid.columns(); ++column) {
    low[column] = 0.0;
    high[column] = glm::radians(90.0);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
      auto const cell = row * grid.columns() + column;
      double const altitude = directions[cell].altitude;
      (is_stopped(shares[cell]) ? low : high)[column] = altitude;
      if (!is_stopped(shares[cell])) break;
    }
  }
  constexpr double resolution = 0.01;  // degrees
  int const halvings = static_cast<int>(std::ceil(std::log2(grid.step() / resolution)));
  for (int i = 0; i < halvings; ++i) {
    std::vector<SunDirection> middles;
    for (std::size_t column = 0; column < grid.columns(); ++column) {
      middles.push_back({directions[column].azimuth, (low[column] + high[column]) / 2.0});
    }
    auto const found = trace_shares(rays, conditions, kinds, points, middles);
    for (std::size_t column = 0; column < grid.columns(); ++column) {
      (is_stopped(found[column]) ? low : high)[column] = middles[column].altitude;
    }
  }
  std::vector<double> heights;
  for (std::size_t column = 0; column < grid.columns(); ++column) {
    heights.push_back(low[column] > 0.0 ? glm::degrees((low[column] + high[column]) / 2.0) : 0.0);
  }
  return heights;
}

}  // namespace gpu_shading::energyplus
