#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// The directions in which EnergyPlus looks at the sky (Engineering Reference, "Shadowing of Sky
// Diffuse Solar Radiation"): azimuths in multiples of 15 degrees, altitudes of 7.5 degrees and
// steps of 15 from there.
inline constexpr int sky_rows = 6;
inline constexpr int sky_columns = 24;
inline constexpr double sky_step = std::numbers::pi / 12.0;

// In the order in which EnergyPlus asks for them: rows from the horizon, each from the north
// clockwise.
std::vector<SunDirection> const& sky_patches();

// Whether EnergyPlus uses the direction as a patch of the sky. It is practically impossible for the
// sun to be exactly there, and harmless.
inline bool is_sky_patch(SunDirection sun) {
  // Tolerance of angles up to 2 pi in single precision, several times the rounding.
  constexpr double rounding = 1e-6;
  auto const on_grid = [](double angle) {
    return std::abs(std::remainder(angle, sky_step)) < rounding;
  };
  return sun.altitude > 0.0 && on_grid(sun.altitude - 0.5 * sky_step) && on_grid(sun.azimuth);
}

}  // namespace gpu_shading::energyplus
