#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "gpu_shading/renderer.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// Red, green and blue, 0 .. 255.
using Colour = glm::dvec3;

inline constexpr double brightest = 255.0;
inline constexpr Colour sky(226.0, 234.0, 243.0);  // neither white nor a grey
// In a view from elsewhere than the sun:
inline constexpr Colour ground(229.0, 233.0, 229.0);
inline constexpr Colour sand(208.0, 200.0, 186.0);   // casts shadows only
inline constexpr Colour slate(128.0, 138.0, 152.0);  // a receiver that faces away from the sun
inline constexpr Colour bronze(156.0, 108.0, 62.0);  // a perforated screen
inline constexpr Colour leaves(106.0, 142.0, 78.0);  // a crown
inline constexpr Colour glass(120.0, 176.0, 200.0);  // a surface that transmits

// Grey by a surface's tilt to the sun: light where it faces the sun, dark where it is edge-on.
Colour tilt_grey(Surface const& surface, glm::dvec3 const& towards_sun);

// By colour_at(column, row), rows from the bottom.
template <typename ColourAt>
Image make_image(int width, int height, ColourAt colour_at) {
  Image image{width, height, 3, {}};
  image.pixels.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = height - 1; row >= 0; --row) {
    for (int column = 0; column < width; ++column) {
      Colour const colour = colour_at(column, row);
      for (int channel = 0; channel < image.channels; ++channel) {
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(colour[channel])));
      }
    }
  }
  return image;
}

}  // namespace gpu_shading
