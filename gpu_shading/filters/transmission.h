#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "filters/transmittance/shades.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// The effect of a caster on the beam at one sun direction.
struct Shade {
  float transmittance = 0.0F;                   // 0: opaque
  std::int32_t schedule = Shades::unscheduled;  // as Shades numbers them
};

// The transmittances of the casters of a scene.
class Transmission {
 public:
  explicit Transmission(Scene const& scene) : shades_(scene), screens_(scene) {}

  Shades const& shades() const { return shades_; }
  Screens const& screens() const { return screens_; }

  // Deployed fractions of screens, 1 beyond the end.
  void set_deployments(std::vector<double> shares) { deployments_ = std::move(shares); }

  bool any_transmits(std::span<SurfaceId const> casters) const;
  bool any_schedule(std::span<SurfaceId const> casters) const;
  bool any_screen(std::span<SurfaceId const> casters) const;
  // Casters that have more than a screen.
  std::vector<SurfaceId> plain_among(std::span<SurfaceId const> casters) const;
  std::vector<int> screens_among(std::span<SurfaceId const> casters) const;

  Shade shade(SurfaceId id, glm::dvec3 const& towards_sun) const;

  // By index, the screens in view; empty for others.
  std::vector<SheetInBeam> sheets(ScreensAtDirection const& wanted) const {
    return sheets_in_beam(screens_, wanted, deployments_);
  }

 private:
  Shades shades_;
  Screens screens_;
  std::vector<double> deployments_;
};

}  // namespace gpu_shading
