#include "pictures/receiver_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

// The kernel by which samples become pixels behind screens, in pixels: wide enough that holes of
// about a pixel leave no moire.
constexpr int fine_samples = 4;  // per side of a pixel
constexpr double spread = 0.75;
constexpr int kernel_pixels = 2;  // to each side of a pixel

// The weights of samples along a side, from the first that counts, which add up to 1.
std::vector<double> kernel() {
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = 0; i < fine_samples * (2 * kernel_pixels + 1); ++i) {
    double const from_middle = (i + 0.5) / fine_samples - (kernel_pixels + 0.5);
    weights.push_back(std::exp(-0.5 * (from_middle / spread) * (from_middle / spread)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Pixels from samples; at the edges by those of the weights that are within.
std::vector<float> smoothed(std::vector<float> const& fine, int width, int height) {
  auto const weights = kernel();
  auto const pass = [&](std::vector<float> const& from, int columns, int rows) {
    // Of rows of samples, as columns of pixels: the second pass turns it back.
    int const pixels = columns / fine_samples;
    std::vector<float> to(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
      for (int pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0.0;
        double weight = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
          int const column = fine_samples * (pixel - kernel_pixels) + static_cast<int>(i);
          if (column < 0 || column >= columns) continue;
          sum += weights[i] *
                 static_cast<double>(
                     from[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(column)]);
          weight += weights[i];
        }
        to[static_cast<std::size_t>(pixel) * static_cast<std::size_t>(rows) +
           static_cast<std::size_t>(row)] = static_cast<float>(sum / weight);
      }
    }
    return to;
  };
  return pass(pass(fine, width * fine_samples, height * fine_samples), height * fine_samples,
              width);
}

// By `draw` in a grid of samples, if the rasteriser has room for it, or of pixels.
template <typename Draw>
std::vector<float> without_moire(PictureRaster const& raster, PictureGrid grid, Draw const& draw) {
  int const width = grid.width;
  int const height = grid.height;
  if (std::max(width, height) > raster.max_pixels() / fine_samples) return draw(grid);
  grid.width *= fine_samples;
  grid.height *= fine_samples;
  return smoothed(draw(grid), width, height);
}

bool is_body(Surface const& surface) {
  auto const kind = surface.filter.look().kind;
  return kind == FilterLook::Kind::holes || kind == FilterLook::Kind::foliage;
}

// The surroundings of the receiver; screens and crowns are drawn over the surfaces behind.
std::vector<Colour> draw_surroundings(PictureRaster& raster, Scene const& scene,
                                      ShadedReceiver const& shaded, PictureGrid const& grid,
                                      bool screened) {
  std::vector<SurfaceId> others;
  std::vector<Colour> by_number{sky};
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    by_number.push_back(tilt_grey(scene[id], shaded.towards_sun));
    if (!is_body(scene[id]) && id != shaded.receiver) others.push_back(id);
  }
  std::vector<Colour> colours;
  colours.reserve(grid.pixels());
  for (std::uint32_t const number : raster.nearest(grid, others)) {
    colours.push_back(by_number[number]);
  }
  if (!screened) return colours;
  auto const passed = without_moire(raster, grid, [&](PictureGrid const& fine) {
    return raster.through_bodies(fine, shaded.towards_sun, others);
  });
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] *= static_cast<double>(passed[i]);
  return colours;
}

}  // namespace

Image draw_receiver(PictureRaster& raster, Scene const& scene, ShadedReceiver const& shaded,
                    PlaneFrame const& frame, int size) {
  PictureGrid grid = grid_around(scene, shaded, frame.origin, size);
  bool screened = false;
  for (SurfaceId id = 0; id < scene.size(); ++id) screened = screened || is_body(scene[id]);
  std::vector<Colour> colours = draw_surroundings(raster, scene, shaded, grid, screened);
  std::vector<std::uint32_t> const receiver = raster.nearest(grid, {&shaded.receiver, 1});
  grid.view.cut = glm::dvec4(frame.normal, 0.0);
  auto const lit = [&](PictureGrid const& fine) { return raster.luminance(fine, shaded); };
  std::vector<float> const luminance = screened ? without_moire(raster, grid, lit) : lit(grid);
  bool const faces_sun = glm::dot(frame.normal, shaded.towards_sun) > edge_on;
  // The receiver on top: surfaces between it and the sun show as its shadow.
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (receiver[i] == 0) continue;
    double const share = faces_sun ? static_cast<double>(luminance[i]) : 0.0;
    colours[i] = fraction_colour(share);
  }
  return make_image(grid.width, grid.height, [&](int column, int row) {
    return colours[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                   static_cast<std::size_t>(column)];
  });
}

}  // namespace gpu_shading
