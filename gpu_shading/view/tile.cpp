#include "view/tile.h"

#include <array>
#include <glm/common.hpp>
#include <limits>

#include "geometry/r2_sequence.h"
#include "geometry/triangulation.h"
#include "view/pixel_mask.h"

namespace gpu_shading {
namespace {

constexpr int largest_side = 4096;

void lay_out(Tile& tile, Mesh const& mesh, PlaneFrame const& frame) {
  tile.triangles.clear();
  tile.triangles.reserve(mesh.indices.size());
  for (std::uint32_t const index : mesh.indices) {
    tile.triangles.emplace_back(tile.map(frame, mesh.vertices[index]));
  }
  PixelMask mask;
  mask.start(tile.side, 0, tile.side);
  for (ConvexArea const& area : outline_on(tile, pixels_of(tile))) mask.light(area);
  tile.counted_pixels = mask.lit();
}

// Shifts of less than half a pixel, for which the margin leaves room, spread evenly for any count.
void place_lattice(Tile& tile, Mesh const& mesh, PlaneFrame const& frame, double net, int places) {
  glm::dvec2 const middle = tile.map.offset;
  double const wanted = net / tile.pixel_area;
  Tile trial = tile;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < places; ++i) {
    glm::dvec2 const share = glm::fract(static_cast<double>(i) * r2_step);
    glm::dvec2 const shift = i == 0 ? glm::dvec2(0.0) : share - 0.5;
    trial.map.offset = middle + shift * (2.0 / tile.side);
    lay_out(trial, mesh, frame);
    double const off = std::abs(static_cast<double>(trial.counted_pixels) - wanted);
    if (off >= least) continue;
    least = off;
    tile = trial;
  }
}

}  // namespace

Tile make_tile(Polygon const& polygon, PlaneFrame const& frame, int resolution, int most,
               TileLay const& lay) {
  double const net = area(polygon);
  double const wanted = std::max(fewest_pixels, resolution * (resolution / 16.0));
  int const limit = std::max(resolution, std::min(largest_side, most));
  Tile tile;
  tile.side = resolution;
  tile.lay = lay;
  for (;;) {
    tile.map = fit_tile(frame, polygon.outline, tile.side, lay);
    tile.pixel_area = tile.map.pixel_area(tile.side);
    if (net >= wanted * tile.pixel_area || tile.side > limit / 2) break;
    tile.side *= 2;
  }
  if (net < fewest_pixels * tile.pixel_area) return bounding_tile(polygon, frame, tile.side);
  // A stretched tile is one of several of a receiver, and few views have the same.
  int const places = lay.for_grids ? 1 : lay.stretch == 1.0 ? 16 : 2;
  place_lattice(tile, triangulate(polygon), frame, net, places);
  return tile.counted_pixels > 0 ? tile : bounding_tile(polygon, frame, tile.side);
}

View in_pixels(View view, TileGrid const& grid) {
  glm::dvec4 const shift(0.0, 0.0, 0.0, 1.0);
  view.x = 0.5 * grid.width * (view.x + shift) + grid.shift.x * shift;
  view.y = 0.5 * grid.rows * (view.y + shift) + grid.shift.y * shift;
  view.x += grid.shear * view.y;
  return view;
}

glm::dvec2 on_grid(glm::dvec2 const& place, TileGrid const& grid) {
  glm::dvec2 pixels = (0.5 * place + 0.5) * glm::dvec2(grid.width, grid.rows) + grid.shift;
  pixels.x += grid.shear * pixels.y;
  return pixels;
}

std::vector<ConvexArea> outline_on(Tile const& tile, TileGrid const& grid) {
  std::vector<ConvexArea> areas;
  for (std::size_t i = 0; i < tile.triangles.size(); i += 3) {
    std::array<glm::dvec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners.at(k) = on_grid(tile.triangles[i + k], grid);
    areas.push_back(area_within(corners, grid.side()));
  }
  return areas;
}

Polygon bounding_rectangle(PlaneFrame const& frame) {
  glm::dvec3 const u = 0.5 * frame.width * frame.u;
  glm::dvec3 const v = 0.5 * frame.height * frame.v;
  glm::dvec3 const& o = frame.origin;
  return {{o - u - v, o + u - v, o + u + v, o - u + v}, {}};
}

Tile bounding_tile(Polygon const& polygon, PlaneFrame const& frame, int side) {
  Polygon const rectangle = bounding_rectangle(frame);
  Tile tile;
  tile.side = side;
  tile.map = fit_tile(frame, rectangle.outline, side);
  lay_out(tile, triangulate(rectangle), frame);
  // The shape that represents the receiver is larger than it, so a pixel counts for less.
  tile.pixel_area = tile.map.pixel_area(side) * area(polygon) / area(rectangle);
  return tile;
}

}  // namespace gpu_shading
