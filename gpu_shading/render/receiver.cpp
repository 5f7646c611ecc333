#include "render/receiver.h"

#include <algorithm>

#include "scene/triangulation.h"

namespace gpu_shading {
namespace {

constexpr int largest_side = 4096;

void lay_out(Tile& tile, Polygon const& polygon, PlaneFrame const& frame) {
  Mesh const mesh = triangulate(polygon);
  tile.triangles.reserve(mesh.indices.size());
  for (std::uint32_t const index : mesh.indices) {
    tile.triangles.emplace_back(tile.map(frame, mesh.vertices[index]));
  }
}

Polygon bounding_rectangle(PlaneFrame const& frame) {
  glm::dvec3 const u = 0.5 * frame.width * frame.u;
  glm::dvec3 const v = 0.5 * frame.height * frame.v;
  glm::dvec3 const& o = frame.origin;
  return {{o - u - v, o + u - v, o + u + v, o - u + v}, {}};
}

}  // namespace

Tile make_tile(Polygon const& polygon, PlaneFrame const& frame, int resolution, int most) {
  double const net = area(polygon);
  double const wanted = std::max(fewest_pixels, resolution * (resolution / 64.0));
  int const limit = std::max(resolution, std::min(largest_side, most));
  Tile tile;
  tile.side = resolution;
  for (;;) {
    tile.map = fit_tile(frame, polygon.outline, tile.side);
    tile.pixel_area = tile.map.pixel_area(tile.side);
    if (net >= wanted * tile.pixel_area || tile.side > limit / 2) break;
    tile.side *= 2;
  }
  if (net < fewest_pixels * tile.pixel_area) return bounding_tile(polygon, frame, tile.side);
  lay_out(tile, polygon, frame);
  return tile;
}

Tile bounding_tile(Polygon const& polygon, PlaneFrame const& frame, int side) {
  Polygon const rectangle = bounding_rectangle(frame);
  Tile tile;
  tile.side = side;
  tile.map = fit_tile(frame, rectangle.outline, side);
  lay_out(tile, rectangle, frame);
  // What stands for the receiver is larger than it: a pixel counts for less.
  tile.pixel_area = tile.map.pixel_area(side) * area(polygon) / area(rectangle);
  return tile;
}

}  // namespace gpu_shading
