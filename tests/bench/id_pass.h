#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "egl/device.h"
#include "gl/framebuffer.h"
#include "gl/readback.h"
#include "gl/texture.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/sun_direction.h"
#include "render/whole_scene.h"

namespace gpu_shading {

// Sunlit fractions of all surfaces at once: the whole scene as the sun sees it, drawn with depth
// and the surface's number in each pixel, and the pixels of each surface counted. Every surface is
// opaque and casts on every other.
class IdPass {
 public:
  // `side`: pixels, over the scene's extent across the sun's rays both ways. On the first device.
  // Throws DeviceError.
  IdPass(Scene const& scene, int side);
  ~IdPass();
  IdPass(IdPass const&) = delete;
  IdPass& operator=(IdPass const&) = delete;

  // By surface: pixels times a pixel's area by the exact projected area, at most 1; 0 where it is
  // turned away.
  std::vector<double> sunlit_fractions(SunDirection sun);

 private:
  // What lives on the device, made and ended with its context current.
  struct OnDevice {
    OnDevice(std::vector<WholeScene::Vertex> const& vertices, int side);

    WholeScene scene;
    gl::LayeredTexture identities;
    gl::LayeredTexture depth;
    gl::Framebuffer target;
    gl::Readback pixels;
  };

  // By identity.
  std::vector<std::uint32_t> count(std::span<std::uint32_t const> pixels) const;

  int side_;
  egl::Device device_;
  std::vector<glm::dvec3> points_;   // from the middle of them all
  std::vector<glm::dvec3> outward_;  // by surface: its normal times its area
  double reach_ = 1.0;
  std::size_t vertices_ = 0;
  std::optional<OnDevice> on_device_;
};

}  // namespace gpu_shading
