#pragma once

#include <string>
#include <string_view>

#include "model/idf/new_object.h"

namespace gpu_shading::energyplus {

inline constexpr std::string_view local_environment = "SurfaceProperty:LocalEnvironment";

// The fields of a SurfaceProperty:LocalEnvironment; "" where blank.
struct LocalEnvironment {
  std::string name;
  std::string surface;
  std::string sunlit_schedule = {};
  std::string surroundings = {};  // a SurfaceProperty:SurroundingSurfaces
  std::string ground = {};        // a SurfaceProperty:GroundSurfaces
};
NewObject environment_object(LocalEnvironment const& environment);

// A SurfaceProperty:GroundSurfaces of one ground.
struct GroundSurface {
  double view = 0.5;
  std::string temperature_schedule = {};
  std::string reflectance_schedule = {};
};
NewObject ground_object(std::string const& name, GroundSurface const& ground);

}  // namespace gpu_shading::energyplus
