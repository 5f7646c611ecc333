#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// A picture to draw: a receiver as the sun sees it, or the whole scene.
struct View {
  std::string picture;   // a file's name, without folders and blanks
  SunDirection sun;      // above the horizon
  std::string receiver;  // its name, in any case; empty: the whole scene
};

// One picture a line, in text: its file's name, the sun's azimuth (clockwise from north) and
// altitude in degrees, then the receiver's name unless all is shown; parted by blanks, of which a
// receiver's name may hold some.
std::vector<View> read_views(std::filesystem::path const& list);
void write_views(std::filesystem::path const& list, std::vector<View> const& views);

// From degrees. Throws Error where the sun is not above the horizon, at most in the zenith.
SunDirection direction_of_degrees(double azimuth_degrees, double altitude_degrees);

}  // namespace gpu_shading::energyplus
