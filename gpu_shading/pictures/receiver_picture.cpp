#include "pictures/receiver_picture.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gpu_shading/image.h"
#include "pictures/colours.h"
#include "pictures/picture_frame.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

// Around the receiver, as a share of its longer side in the picture.
constexpr double border = 0.15;

// How far the scene reaches from the origin.
double reach_of(Scene const& scene, glm::dvec3 const& origin) {
  double reach = 1.0;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    for (glm::dvec3 const& vertex : scene[id].polygon.outline) {
      reach = std::max(reach, glm::distance(vertex, origin));
    }
  }
  return reach;
}

PictureGrid grid_around(Scene const& scene, ShadedReceiver const& shaded, glm::dvec3 const& origin,
                        int size) {
  SunAxes const axes(shaded.towards_sun);
  PictureFrame outline;
  for (glm::dvec3 const& vertex : scene[shaded.receiver].polygon.outline) {
    outline.include(axes(vertex - origin));
  }
  return make_grid(outline.widened(border * outline.longer()), axes, origin,
                   reach_of(scene, origin), size);
}

// The surroundings of the receiver; screens and crowns are drawn over the surfaces behind.
std::vector<Colour> draw_surroundings(PictureRaster& raster, Scene const& scene,
                                      ShadedReceiver const& shaded, PictureGrid const& grid) {
  std::vector<SurfaceId> others;
  std::vector<Colour> by_number{sky};
  bool screened = false;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    by_number.push_back(tilt_grey(scene[id], shaded.towards_sun));
    auto const kind = scene[id].filter.look().kind;
    if (kind == FilterLook::Kind::holes || kind == FilterLook::Kind::foliage) {
      screened = true;
    } else if (id != shaded.receiver) {
      others.push_back(id);
    }
  }
  std::vector<Colour> colours;
  colours.reserve(grid.pixels());
  for (std::uint32_t const number : raster.nearest(grid, others)) {
    colours.push_back(by_number[number]);
  }
  if (!screened) return colours;
  std::vector<float> const passed = raster.through_bodies(grid, shaded.towards_sun, others);
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] *= static_cast<double>(passed[i]);
  return colours;
}

}  // namespace

Image draw_receiver(PictureRaster& raster, Scene const& scene, ShadedReceiver const& shaded,
                    PlaneFrame const& frame, int size) {
  PictureGrid grid = grid_around(scene, shaded, frame.origin, size);
  std::vector<Colour> colours = draw_surroundings(raster, scene, shaded, grid);
  std::vector<std::uint32_t> const receiver = raster.nearest(grid, {&shaded.receiver, 1});
  grid.view.cut = glm::dvec4(frame.normal, -clearance);
  std::vector<float> const luminance = raster.luminance(grid, shaded);
  bool const faces_sun = glm::dot(frame.normal, shaded.towards_sun) > edge_on;
  bool const opaque = shaded.shades.empty();
  // The receiver on top: surfaces between it and the sun show as its shadow.
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (receiver[i] == 0) continue;
    double const share = faces_sun ? static_cast<double>(luminance[i]) : 0.0;
    colours[i] = opaque ? glm::mix(blue, yellow, share) : fraction_colour(share);
  }
  return make_image(grid.width, grid.height, [&](int column, int row) {
    return colours[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                   static_cast<std::size_t>(column)];
  });
}

}  // namespace gpu_shading
