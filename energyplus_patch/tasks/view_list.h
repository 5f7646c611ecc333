#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// A picture to draw: a receiver as the sun sees it, or the whole scene.
struct SunView {
  std::string picture;   // name of a file, without folders and blanks
  SunDirection sun;      // above the horizon
  std::string receiver;  // its name, in any case; empty: the whole scene
  // Where the whole scene is seen from, with shadows; none: from the sun.
  std::optional<SunDirection> camera = std::nullopt;

  bool operator==(SunView const&) const = default;
};

// A text with one picture per line: its file name, the sun's azimuth (clockwise from north) and
// altitude in degrees, and the receiver's name unless the whole scene is drawn; separated by
// blanks, which a receiver's name may contain. No two pictures have the same name. Throws Error
// with the line.
std::vector<SunView> read_views(std::filesystem::path const& list);

// From degrees. Throws Error if the sun is not above the horizon, or above the zenith.
SunDirection direction_of_degrees(double azimuth_degrees, double altitude_degrees);

}  // namespace gpu_shading::energyplus
