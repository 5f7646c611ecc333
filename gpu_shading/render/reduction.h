#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "gl/texture.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// Sums the pixels of each layer of textures of one side. Nothing waits before sums(), but for sums
// on the CPU, which take a texture at a time.
class Reduction {
 public:
  virtual ~Reduction() = default;

  // What the texture needs.
  virtual gl::LayeredTexture::Levels levels() const = 0;

  // Forgets what was added and makes room for this many layers.
  virtual void begin(std::size_t layers) = 0;
  // The texture may be drawn to again right after.
  virtual void add(gl::LayeredTexture const& luminance, int layers) = 0;
  // In the order they were added.
  virtual std::vector<double> sums() const = 0;
};

std::unique_ptr<Reduction> make_reduction(LuminanceSum how, int side);

}  // namespace gpu_shading
