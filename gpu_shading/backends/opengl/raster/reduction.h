#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

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

// Reads back the numbers of pixels of each identity from 1 on, in the layers of a texture of
// identities, which must outlive it.
class IdentityCounts {
 public:
  virtual ~IdentityCounts() = default;

  // Starts counting what was drawn before, in the first `layers` layers, up to identity `most`.
  virtual void start(int layers, std::size_t most) = 0;
  // The counts, once the device has done the work of start(); valid until the next call.
  virtual std::span<std::uint32_t const> counts(int layer) = 0;
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
  std::unique_ptr<IdentityCounts> count(gl::LayeredTexture const& texture);
  // Bytes per layer besides its pixels.
  std::size_t extra_bytes(int side) const;

  // Read-back of whole pixels.
  gl::Readback::Mode mode() const {
    return how_ == LuminanceSum::readback ? gl::Readback::Mode::when_asked
                                          : gl::Readback::Mode::ahead;
  }

 private:
  LuminanceSum how_;
  gl::Program squares_;  // each once needed
  gl::Program totals_;
  gl::Program identities_;
};

}  // namespace gpu_shading
