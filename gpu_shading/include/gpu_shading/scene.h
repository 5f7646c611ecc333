#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/screen_placement.h"
#include "gpu_shading/shading_rule.h"

namespace gpu_shading {

class PerforatedScreen;  // gpu_shading/perforated_screen.h
class Transmittance;     // gpu_shading/transmittance.h

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
