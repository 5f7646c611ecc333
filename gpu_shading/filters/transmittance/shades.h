#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// The transmittance of the scene's surfaces. Schedules are numbered from 0 here, without gaps.
class Shades {
 public:
  explicit Shades(Scene const& scene);

  bool any() const { return any_; }
  bool transmits(SurfaceId id) const { return entries_[id].transmits; }
  // Whether it has a transmittance or schedule besides its screen.
  bool dims(SurfaceId id) const { return entries_[id].dims; }

  // 1 for a surface that only has a schedule or a screen, 0 for an opaque one. `towards_sun` of
  // unit length.
  double transmittance(SurfaceId id, glm::dvec3 const& towards_sun) const;

  static constexpr int unscheduled = -1;
  int schedule(SurfaceId id) const { return entries_[id].schedule; }
  std::vector<int> const& schedules() const { return schedules_; }  // as the scene numbers them

 private:
  struct Entry {
    bool transmits = false;
    bool dims = true;
    int schedule = unscheduled;
    std::shared_ptr<Transmittance const> model;
    glm::dvec3 normal{0.0};
  };

  std::vector<Entry> entries_;
  std::vector<int> schedules_;
  bool any_ = false;
};

}  // namespace gpu_shading
