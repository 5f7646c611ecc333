#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backends/interface/picture_raster.h"
#include "backends/opengl/egl/device.h"

namespace gpu_shading {

// Draws pictures by OpenGL on an EGL device. The caller's context is current again after every
// call.
class GlPictureRaster : public PictureRaster {
 public:
  // Throws DeviceError.
  GlPictureRaster(egl::Device device, PictureScene const& scene);
  ~GlPictureRaster() override;
  GlPictureRaster(GlPictureRaster const&) = delete;
  GlPictureRaster& operator=(GlPictureRaster const&) = delete;
  GlPictureRaster(GlPictureRaster&&) = delete;
  GlPictureRaster& operator=(GlPictureRaster&&) = delete;

  int max_pixels() const override { return device_.info.max_resolution; }
  std::vector<std::uint32_t> nearest(PictureGrid const& grid,
                                     std::span<SurfaceId const> surfaces) override;
  std::vector<float> through_bodies(PictureGrid const& grid, glm::dvec3 const& towards_sun,
                                    std::span<SurfaceId const> surfaces) override;
  std::vector<float> luminance(PictureGrid const& grid, ShadedReceiver const& shaded) override;

 private:
  // Must be created and destroyed with the context current.
  struct OnDevice;

  egl::Device device_;
  Scene const& scene_;
  Transmission const& transmission_;
  std::unique_ptr<OnDevice> on_device_;
};

}  // namespace gpu_shading
