#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "gpu_shading/scene.h"
#include "scene/perez_sky.h"

namespace gpu_shading::energyplus {

// The sky's diffuse irradiance of surfaces over the unobstructed horizontal one, from its patches
// (--gpu-shading-sky perez-patches).
class SkyMultipliers {
 public:
  // Of surfaces of EnergyPlus's: unit normal x net area (m2).
  explicit SkyMultipliers(std::vector<glm::dvec3> areas) : areas_(std::move(areas)) {}

  // What each patch counts for a surface depends on what shades it: on `shades`, the values of
  // schedules and positions.
  bool knows(std::vector<double> const& shades) const { return shades_ == shades; }

  // Takes the sunlit area of a surface from one of sky_patches(), normal to its rays, m2; nothing
  // if the surface is not shaded.
  void renew(std::vector<double> shades,
             std::function<std::optional<double>(std::size_t patch, SurfaceId surface)> const&
                 sunlit_area);

  // By surface.
  std::vector<double> at(SkyWeather const& weather) const;

 private:
  std::vector<glm::dvec3> areas_;
  std::optional<std::vector<double>> shades_;
  std::vector<std::vector<double>> weights_;  // by surface and patch, sr
};

}  // namespace gpu_shading::energyplus
