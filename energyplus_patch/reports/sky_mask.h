#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/rays.h"
#include "gpu_shading/sun_direction.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// What may shade a receiver.
enum class ShadeKind { building, shades, geometry, trees, neighbours, terrain };
inline constexpr std::size_t shade_kinds = 6;

// "building", "shades", "geometry", "trees", "neighbours", "terrain"
std::string_view name_of(ShadeKind kind);

// By surface of a scene: walls, roofs and reveals are the building; Shading:Building and
// Shading:Zone are shades; GPUShading:Geometry is geometry; GPUShading:Tree are trees; Shading:Site
// and the buildings of GPUShading:SiteContext are neighbours, and its terrain is terrain.
std::vector<ShadeKind> kinds_of(SceneAssembly const& assembly, Scene const& scene);

// The beam from one direction.
struct BeamShare {
  bool faced = false;   // by the receiver; otherwise the rest is 0
  float sunlit = 0.0F;  // 0 .. 1
  // What each kind stops; with `sunlit`, they add up to 1.
  std::array<float, shade_kinds> stopped{};

  bool operator==(BeamShare const&) const = default;
};

// Replaces the sunlit fraction, 0 .. 1, of a share that is faced, and what the kinds stop in
// proportion.
void set_sunlit(BeamShare& share, double fraction);

// Directions at equal steps of azimuth and altitude.
class SkyGrid {
 public:
  // `step`: degrees, a divisor of 90.
  explicit SkyGrid(int step) : step_(step) {}

  int step() const { return step_; }
  std::size_t columns() const { return static_cast<std::size_t>(circle / step_); }
  std::size_t rows() const { return static_cast<std::size_t>(right_angle / step_); }
  std::size_t size() const { return columns() * rows(); }

  // The middle of each cell: rows from the horizon, each from the north clockwise.
  std::vector<SunDirection> directions() const;
  double solid_angle(std::size_t row) const;  // of a cell, sr

 private:
  static constexpr int circle = 360;
  static constexpr int right_angle = 90;

  int step_;
};

// A place that sees the sky: points, each with its share of the receiver, and the unit normal.
struct MaskPoints {
  glm::dvec3 normal{0.0};
  // By cell of the receiver, then by turn: directions that follow each other begin at other points
  // of a cell, so that repeating shades do not alias with the cells.
  std::vector<std::vector<glm::dvec3>> points;
  std::vector<double> shares;  // by cell; they add up to 1
};

// Some `rays` cells of a receiver.
MaskPoints points_of(Polygon const& polygon, int rays);
// A single point in front of a receiver.
MaskPoints point_at(glm::dvec3 const& point, glm::dvec3 const& normal);

// By direction: rays from the points, through what may shade the receiver.
std::vector<BeamShare> trace_shares(RayScene const& rays, RayConditions const& conditions,
                                    std::vector<ShadeKind> const& kinds, MaskPoints const& points,
                                    std::span<SunDirection const> directions);

// View factors to a sky of uniform radiance.
struct SkyView {
  double unshaded = 0.0;  // (1 + cos(tilt)) / 2
  double view = 0.0;
  std::array<double, shade_kinds> stopped{};  // with `view`, they add up to `unshaded`
};
SkyView sky_view(SkyGrid const& grid, std::span<BeamShare const> shares, glm::dvec3 const& normal);

// The altitude, degrees, below which more than half of the beam is stopped, to 0.01 degrees, at the
// middle of each column of the grid; 0 where the receiver does not face the horizon. What hangs
// over a clear part of the sky is no horizon. `shares`: trace_shares() of the grid's directions.
std::vector<double> trace_horizon(RayScene const& rays, RayConditions const& conditions,
                                  std::vector<ShadeKind> const& kinds, MaskPoints const& points,
                                  SkyGrid const& grid, std::span<BeamShare const> shares);

}  // namespace gpu_shading::energyplus
