#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {

class Transmittance;  // gpu_shading/transmittance.h

// Position of a surface in its scene, counted from 0 in the order of Scene::add.
using SurfaceId = std::uint32_t;

using Ring = std::vector<glm::dvec3>;

// A planar polygon in metres; world axes, x east, y north, z up. The outline runs counter-clockwise
// as seen from outside (the side that the sun may light); holes may run either way. Fewer than
// three distinct vertices, or no area: the polygon neither casts nor receives. Non-convex is
// allowed; a polygon that is not quite planar is taken at its Newell plane as a receiver and as it
// stands as a caster.
struct Polygon {
  Ring outline;
  std::vector<Ring> holes;
};

// When a surface shades others.
enum class Casting {
  always,       // a sheet: both its faces stop the sun
  turned_away,  // only while its outside is not in the sun: enough for each face of a closed body,
                // and what EnergyPlus's PolygonClipping takes of walls, roofs and windows
  never,        // it only receives
};

// As a caster a surface is opaque, unless it has a transmittance, a schedule or both, which
// multiply: then it is a flat sheet that lets the beam through, straight on. Both faces do alike.
// The angle of incidence is taken from the Newell normal of the outline. The sun's rays are
// parallel, so that it is one number for each surface and direction: it is computed in double
// precision for those in view, with no table between the model and the answer.
struct Surface {
  std::string name;
  Polygon polygon;
  Casting casting = Casting::always;
  std::shared_ptr<Transmittance const> transmittance = nullptr;
  // Number of a factor, 0 .. 1, that varies with time; -1: none. Surfaces may share one. Answers
  // keep what passed each schedule apart (Sunlit), so that they hold whatever the factors are.
  int schedule = -1;
  // A perforated sheet: what passes its holes, as the transmittance and the schedule have it.
  std::shared_ptr<PerforatedScreen const> screen = nullptr;
  ScreenPlacement placement = {};
  // Number of the share of the screen that is in place (Renderer::set_deployments); -1: all of it,
  // always.
  int deployment = -1;
};

// Whether a caster counts for a receiver. Asked for each pair in view, at each direction, by
// several threads at a time; may not change its mind.
using ShadingRule = std::function<bool(SurfaceId receiver, SurfaceId caster)>;

// Every surface that can cast or receive. Each one casts on every other, but where the rule says
// no; a surface never shades itself.
class Scene {
 public:
  SurfaceId add(Surface surface);

  std::size_t size() const { return surfaces_.size(); }
  Surface const& operator[](SurfaceId id) const { return surfaces_.at(id); }

  void set_rule(ShadingRule rule) { rule_ = std::move(rule); }
  bool may_shade(SurfaceId receiver, SurfaceId caster) const;

 private:
  std::vector<Surface> surfaces_;
  ShadingRule rule_;
};

// Area of the outline less its holes (m2), and the outline's unit normal, both by Newell's method
// (Sutherland, Sproull & Schumacker 1974). The zero vector for a degenerate polygon.
double area(Polygon const& polygon);
glm::dvec3 normal(Polygon const& polygon);

// A screen's placement on a polygon, written out in world axes. The polygon has to have an area;
// one that is not quite planar is taken at its plane.
struct TileAxes {
  glm::dvec3 origin;  // the tile's (0, 0)
  glm::dvec3 u;       // unit vectors
  glm::dvec3 v;
};
TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement);

}  // namespace gpu_shading
