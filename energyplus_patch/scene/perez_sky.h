#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading::energyplus {

// The sun and the weather of a timestep.
struct SkyWeather {
  glm::dvec3 towards_sun{0.0, 0.0, 1.0};  // unit; x east, y north, z up: above the horizon
  double beam = 0.0;                      // direct normal irradiance, W/m2
  double diffuse = 0.0;                   // diffuse horizontal irradiance, W/m2; above 0
  int day_of_year = 1;                    // 1 .. 366

  // Irradiance of level ground in the open, W/m2.
  double open_ground() const { return beam * std::max(0.0, towards_sun.z) + diffuse; }

  // The reflectance of level ground in the open that reflects so much, W/m2; 0 without light.
  double ground_reflectance(double reflected) const {
    double const open = open_ground();
    return open > 0.0 ? reflected / open : 0.0;
  }
};

// The sky's mean radiance in each of sky_patches(), in 1/sr, for a diffuse horizontal irradiance of
// 1: the all-weather model of R. Perez, R. Seals and J. Michalsky, "All-weather model for sky
// luminance distribution", Solar Energy 50(3), 1993, with the limits of its parameters that
// Radiance's gendaymtx has.
std::vector<double> perez_radiances(SkyWeather const& weather);

// Of each of sky_patches(), sr.
std::vector<double> const& patch_solid_angles();

// The integral of the cosine of incidence on a plane over each of sky_patches(), sr; `normal`:
// unit. Their sum is pi times the plane's view factor to the sky.
std::vector<double> patch_projections(glm::dvec3 const& normal);

}  // namespace gpu_shading::energyplus
