#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gpu_shading/beam_filter.h"
#include "gpu_shading/polygon.h"
#include "gpu_shading/shading_rule.h"

namespace gpu_shading {

// When a surface casts shadows.
enum class Casting {
  always,       // a sheet: both faces stop the sun
  turned_away,  // only while it faces away from the sun: enough for each face of a closed body,
                // and what EnergyPlus's PolygonClipping does for walls, roofs and windows
  never,        // it is only a receiver
};

struct Surface {
  std::string name;
  Polygon polygon;
  Casting casting = Casting::always;
  BeamFilter filter = {};  // what it does to the beam as a caster
};

// All surfaces that can cast or receive. Each one casts on every other unless the rule forbids it;
// a surface never shades itself.
class Scene {
 public:
  // Returns the surface's index, counted from 0. Throws Error if there is a shading rule already.
  SurfaceId add(Surface surface);

  std::size_t size() const { return surfaces_.size(); }
  // Throws std::out_of_range for an index that add() has not returned.
  Surface const& operator[](SurfaceId id) const { return surfaces_.at(id); }

  // All surfaces must have been added. Throws Error if the rule lacks a role for a surface, or a
  // role's zone.
  void set_rule(ShadingRule rule);
  ShadingRule const& rule() const { return rule_; }
  // Whether a caster counts for a receiver.
  bool may_shade(SurfaceId receiver, SurfaceId caster) const;

 private:
  std::vector<Surface> surfaces_;
  ShadingRule rule_;
};

}  // namespace gpu_shading
