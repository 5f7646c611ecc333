#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/shading_rule.h"

namespace gpu_shading {

class Transmittance;  // gpu_shading/transmittance.h

using Ring = std::vector<glm::dvec3>;

// A planar polygon in metres, in world axes: x east, y north, z up. The outline runs
// counterclockwise as seen from outside (the side that the sun may light); holes may run either
// way. A polygon with fewer than three distinct vertices or without area neither casts nor
// receives. Non-convex polygons are allowed. A polygon that is not quite planar is projected to its
// Newell plane as a receiver, and used unchanged as a caster.
struct Polygon {
  Ring outline;
  std::vector<Ring> holes;
};

// When a surface casts shadows.
enum class Casting {
  always,       // a sheet: both faces stop the sun
  turned_away,  // only while it faces away from the sun: enough for each face of a closed body,
                // and what EnergyPlus's PolygonClipping does for walls, roofs and windows
  never,        // it is only a receiver
};

// As a caster, a surface is opaque unless it has a transmittance, a schedule, or both, which
// multiply. It is then a flat sheet that transmits the beam straight through, equally through both
// faces. The angle of incidence is taken from the Newell normal of the outline. Because the sun's
// rays are parallel, it is one number for each surface and direction; it is computed in double
// precision for surfaces in view, with no table between the model and the answer.
struct Surface {
  std::string name;
  Polygon polygon;
  Casting casting = Casting::always;
  std::shared_ptr<Transmittance const> transmittance = nullptr;
  // Index of a factor, 0 .. 1, that varies with time; -1: none. Surfaces may share one. Answers
  // store separately what passed each schedule (Sunlit), so they hold for any factors.
  int schedule = -1;
  // A perforated sheet; its transmittance multiplies the transmittance and the schedule.
  std::shared_ptr<PerforatedScreen const> screen = nullptr;
  ScreenPlacement placement = {};
  // Index of the deployed fraction of the screen (Renderer::set_deployments); -1: always fully
  // deployed.
  int deployment = -1;
};

// All surfaces that can cast or receive. Each one casts on every other unless the rule forbids it;
// a surface never shades itself.
class Scene {
 public:
  SurfaceId add(Surface surface);

  std::size_t size() const { return surfaces_.size(); }
  Surface const& operator[](SurfaceId id) const { return surfaces_.at(id); }

  // All surfaces have to be there. Throws Error where the rule lacks a surface's role, or a role's
  // zone.
  void set_rule(ShadingRule rule);
  ShadingRule const& rule() const { return rule_; }
  bool may_shade(SurfaceId receiver, SurfaceId caster) const;

 private:
  std::vector<Surface> surfaces_;
  ShadingRule rule_;
};

// Area of the outline minus its holes (m2), and the unit normal of the outline, both by Newell's
// method (Sutherland, Sproull & Schumacker 1974). The zero vector for a degenerate polygon.
double area(Polygon const& polygon);
glm::dvec3 normal(Polygon const& polygon);

// A screen's placement on a polygon, in world axes. The polygon must have an area; if it is not
// quite planar, its plane is used.
struct TileAxes {
  glm::dvec3 origin;  // the tile's (0, 0)
  glm::dvec3 u;       // unit vectors
  glm::dvec3 v;
};
TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement);

}  // namespace gpu_shading
