#pragma once

#include <cstddef>
#include <memory>

#include "gl/program.h"
#include "gl/readback.h"
#include "gl/texture.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// Brings back the sums over pixels of the layers of a texture of units or reals, which has to
// outlive it: in a fixed order.
class Reduction {
 public:
  virtual ~Reduction() = default;

  // Of what was drawn before, in the first `layers` layers.
  virtual void start(int layers) = 0;
  // Once the device has done what start() asked for.
  virtual double sum(int layer) = 0;
};

// How sums are made on a device.
class Summing {
 public:
  // Neither is automatic.
  explicit Summing(LuminanceSum how) : how_(how) {}

  // Of what a texture needs to be summed.
  gl::LayeredTexture::Levels levels(gl::Pixel pixel) const;
  // Of units only where whole pixels are brought back ahead.
  std::unique_ptr<Reduction> make(gl::LayeredTexture const& texture);
  // Bytes of a layer beside its pixels.
  std::size_t extra_bytes(gl::Pixel pixel, int side) const;

  // Of whole pixels.
  gl::Readback::Way way() const {
    return how_ == LuminanceSum::readback ? gl::Readback::Way::when_asked
                                          : gl::Readback::Way::ahead;
  }

 private:
  LuminanceSum how_;
  gl::Program squares_;  // once needed
};

}  // namespace gpu_shading
