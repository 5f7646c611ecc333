#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "geometry/convex_area.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/scene.h"
#include "view/view.h"

namespace gpu_shading {

// A receiver's layout in pixels.
struct Tile {
  int side = 0;  // pixels
  TileLay lay;
  TileMap map;
  std::vector<glm::vec2> triangles;  // in clip coordinates
  double pixel_area = 0.0;           // area of a pixel in the receiver's plane, m2
  std::uint64_t counted_pixels = 0;  // number of the receiver's own pixels; never 0
};

// `resolution` pixels per side, doubled while a receiver that fills little of its bounding
// rectangle, such as the ring of wall around a large window, has fewer than resolution^2 / 16
// pixels or fewer than 16, up to the larger of `resolution` and the smaller of 4096 and `most`.
// Among several offsets of the pixel grid, the one is used at which the receiver's own pixels come
// closest to its area.
Tile make_tile(Polygon const& polygon, PlaneFrame const& frame, int resolution, int most,
               TileLay const& lay = {});

Polygon bounding_rectangle(PlaneFrame const& frame);

// For receivers that are still too thin: the whole bounding rectangle, which always has a pixel in
// its centre.
Tile bounding_tile(Polygon const& polygon, PlaneFrame const& frame, int side);

// Converts clip coordinates of a view or a tile, -1 .. 1, to pixels.
inline glm::dvec2 to_pixels(glm::dvec2 const& place, int side) {
  return (0.5 * place + 0.5) * static_cast<double>(side);
}

// Places on a tile where it is sampled, at the centres of a mask's pixels: those of its own pixels,
// or of others.
struct TileGrid {
  int width = 0;  // columns across the tile
  int rows = 0;   // up the tile
  double shear =
      0.0;  // columns by which a row is shifted to the right of the one below it; not < 0
  glm::dvec2 shift{0.0};  // of the tile against the grid, 0 .. 1 columns and rows

  // Of a mask.
  int columns() const { return width + static_cast<int>(std::ceil(shear * mask_rows() + shift.x)); }
  int mask_rows() const { return shift.y > 0.0 ? rows + 1 : rows; }
  int side() const { return std::max(columns(), mask_rows()); }
  bool operator==(TileGrid const&) const = default;

  // A vector of the reciprocal lattice, in cycles per tile: waves that are the same at all places.
  glm::dvec2 reciprocal(double column, double row) const {
    return {column * width, (column * shear + row) * rows};
  }
};

inline TileGrid pixels_of(Tile const& tile) { return {tile.side, tile.side, 0.0}; }

// A view of a tile with its x and y in columns and rows of the tile's grid.
View in_pixels(View view, TileGrid const& grid);
// The same for a place on the tile, in clip coordinates.
glm::dvec2 on_grid(glm::dvec2 const& place, TileGrid const& grid);

// The receiver, in columns and rows.
std::vector<ConvexArea> outline_on(Tile const& tile, TileGrid const& grid);

// With fewer expected pixels than this, the sunlit fraction is left to chance.
inline constexpr double fewest_pixels = 16.0;

}  // namespace gpu_shading
