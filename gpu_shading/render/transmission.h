#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "render/draw_list.h"
#include "render/schedule_keys.h"
#include "scene/screens.h"
#include "scene/shades.h"

namespace gpu_shading {

// What the casters of a scene, which must outlive it, let through.
class Transmission {
 public:
  explicit Transmission(Scene const& scene) : scene_(scene), shades_(scene), screens_(scene) {}

  Shades const& shades() const { return shades_; }
  Screens const& screens() const { return screens_; }

  // Shares of screens in place, 1 where too few.
  void set_deployments(std::vector<double> shares) { deployments_ = std::move(shares); }
  std::span<double const> deployments() const { return deployments_; }

  bool any_transmits(std::span<SurfaceId const> casters) const;
  bool any_schedule(std::span<SurfaceId const> casters) const;
  bool any_screen(std::span<SurfaceId const> casters) const;
  // Those that are more than screens.
  std::vector<SurfaceId> plain_among(std::span<SurfaceId const> casters) const;
  std::vector<int> screens_among(std::span<SurfaceId const> casters) const;

  Shade shade(SurfaceId id, glm::dvec3 const& towards_sun) const;

  // Of all schedules, to tell apart those before a receiver; nothing when none of its casters has
  // one. Throws Error when there are too many.
  std::optional<ScheduleKeys> keys(SurfaceId receiver, std::span<SurfaceId const> casters) const;

  // The screens of a list at its directions, one after another.
  ScreenView see(std::span<DirectionTables const> directions, int most_texels) const;

 private:
  Scene const& scene_;
  Shades shades_;
  Screens screens_;
  std::vector<double> deployments_;
};

}  // namespace gpu_shading
