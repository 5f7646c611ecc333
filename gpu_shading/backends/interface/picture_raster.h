#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "filters/transmission.h"
#include "geometry/triangulation.h"
#include "gpu_shading/scene.h"
#include "view/view.h"

namespace gpu_shading {

// The pixels of a picture: x of a view runs from -1 to 1 over its columns, y over its rows, from
// the bottom. z is 0 or more and 1 or less wherever there is a surface.
struct PictureGrid {
  View view;
  int width = 0;
  int height = 0;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  // What a pixel covers across the beam, m2; x and y must be at right angles across it.
  double pixel_area() const {
    double const scale = glm::length(glm::dvec3(view.x)) * glm::length(glm::dvec3(view.y));
    return 4.0 / (scale * static_cast<double>(width) * static_cast<double>(height));
  }
};

// A receiver at one direction of the sun, and what shades it.
struct ShadedReceiver {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
  std::vector<SurfaceId> casters;  // in view
  // One for each caster, schedules applied; empty if all are opaque.
  std::vector<Shade> shades;
};

// What pictures are made of. All but the meshes must outlive the rasteriser.
struct PictureScene {
  Scene const& scene;
  std::span<Mesh const> meshes;  // of all of the scene's surfaces, by id
  Transmission const& transmission;
};

// Rasterises a scene for pictures: values by pixel, row after row from the bottom. One thread at a
// time. Every function throws DeviceError when the device fails.
class PictureRaster {
 public:
  PictureRaster() = default;
  virtual ~PictureRaster() = default;
  PictureRaster(PictureRaster const&) = delete;
  PictureRaster& operator=(PictureRaster const&) = delete;
  PictureRaster(PictureRaster&&) = delete;
  PictureRaster& operator=(PictureRaster&&) = delete;

  // Pixels that a grid may have a side.
  virtual int max_pixels() const = 0;

  // The nearest of some surfaces, its id plus 1; 0 where there is none.
  virtual std::vector<std::uint32_t> nearest(PictureGrid const& grid,
                                             std::span<SurfaceId const> surfaces) = 0;

  // The share of light, 0 .. 1, that all bodies nearer than the nearest of some surfaces let
  // through.
  virtual std::vector<float> through_bodies(PictureGrid const& grid, glm::dvec3 const& towards_sun,
                                            std::span<SurfaceId const> surfaces) = 0;

  // The luminance, 0 .. 1, of a receiver's plane behind those of its casters that are in front of
  // the view's cut, by the rules by which a ViewBackend answers; 0 or 1 where all are opaque.
  virtual std::vector<float> luminance(PictureGrid const& grid, ShadedReceiver const& shaded) = 0;
};

}  // namespace gpu_shading
