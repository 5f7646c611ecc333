#pragma once

#include <cstddef>
#include <memory>

#include "backends/opengl/gl/program.h"
#include "backends/opengl/gl/readback.h"
#include "backends/opengl/gl/texture.h"

namespace gpu_shading {

// Reads back the sums over pixels of the layers of a texture of units or reals, which must outlive
// it. Sums have a fixed order.
class Reduction {
 public:
  virtual ~Reduction() = default;

  // Starts summing what was drawn before, in the first `layers` layers.
  virtual void start(int layers) = 0;
  // The sums, once the device has done the work of start().
  virtual double sum(int layer) = 0;
};

// How luminance is summed, in a fixed order each; the results differ by rounding only.
enum class LuminanceSum {
  compute,   // by a compute shader
  readback,  // on the CPU
};

// How sums are computed on a device.
class Summing {
 public:
  explicit Summing(LuminanceSum how) : how_(how) {}

  // For units, only if whole pixels are read back ahead.
  std::unique_ptr<Reduction> make(gl::LayeredTexture const& texture);
  // Bytes per layer besides its pixels.
  std::size_t extra_bytes(int side) const;

  // Read-back of whole pixels.
  gl::Readback::Mode mode() const {
    return how_ == LuminanceSum::readback ? gl::Readback::Mode::when_asked
                                          : gl::Readback::Mode::ahead;
  }

 private:
  LuminanceSum how_;
  gl::Program squares_;  // once needed
};

}  // namespace gpu_shading
