#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <vector>

#include "gpu_shading/scene.h"
#include "render/pixel_mask.h"
#include "render/view.h"
#include "scene/plane_frame.h"

namespace gpu_shading {

// A receiver laid out in pixels.
struct Tile {
  int side = 0;  // pixels
  TileMap map;
  std::vector<glm::vec2> triangles;  // in clip coordinates
  double pixel_area = 0.0;           // m2 of the receiver's plane
  // Of the receiver; never 0. OpenGL, once it has drawn them, rounds corners to parts of a pixel.
  std::uint64_t counted_pixels = 0;
  std::optional<std::uint64_t> drawn_pixels;
};

// `resolution` pixels a side, doubled while a receiver that fills little of its bounding rectangle,
// such as the ring of wall around a large window, is left with fewer than resolution^2 / 64 of them
// or than 16; up to 4096 or `most`, or `resolution` where that is more. Of some places of the
// lattice it has the one at which its own pixels come nearest to its area.
Tile make_tile(Polygon const& polygon, PlaneFrame const& frame, int resolution, int most);

// For receivers too thin even so: all of the bounding rectangle, in whose middle there is always a
// pixel.
Tile bounding_tile(Polygon const& polygon, PlaneFrame const& frame, int side);

// The receiver's own pixels.
void light(PixelMask& mask, Tile const& tile);

// From the places of a view or a tile, -1 .. 1, to pixels.
inline glm::dvec2 to_pixels(glm::dvec2 const& place, int side) {
  return (0.5 * place + 0.5) * static_cast<double>(side);
}

// Pixels expected of less than this leave the share that is lit to chance.
inline constexpr double fewest_pixels = 16.0;

// What is known of a receiver whatever the sun's direction.
struct Receiver {
  std::optional<PlaneFrame> frame;  // nothing when it has no area
  double area = 0.0;                // exact, m2
  std::map<int, Tile> tiles;        // those needed so far, by the resolution asked for
};

}  // namespace gpu_shading
