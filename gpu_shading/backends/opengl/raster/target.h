#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "backends/opengl/raster/geometry.h"
#include "backends/opengl/raster/reduction.h"
#include "backends/opengl/raster/schedule_keys.h"

namespace gpu_shading {

// What a view needs, and so the cheapest way to draw it.
enum class Kind {
  opaque,           // counts sunlit pixels: 1 where the receiver is, 0 behind a caster
  unscheduled,      // 32-bit luminance, which every caster multiplies by its transmittance
  scheduled,        // also the sum of the keys of the schedules passed
  interior,         // sunlit pixels of a window, by the surface that the sun reaches behind it
  shaded_interior,  // the luminance of these, and keys
};

// Layers to which views of one kind are drawn, on tiles of one side, and the read-back of their
// results.
class Target {
 public:
  virtual ~Target() = default;

  // Draws the contents of `geometry`, with views from layer 0 on of up to `parts` sums each,
  // without waiting.
  virtual void draw(Geometry& geometry, int layers, std::size_t parts) = 0;
  // When that is done: sums of a layer's luminance, for a window by the surface behind it.
  virtual void read(int layer, std::span<LuminanceByKey> parts) = 0;
};

// Throws DeviceError if there is not enough memory.
std::unique_ptr<Target> make_target(Kind kind, int side, int layers, Summing& summing);

// Bytes of a layer in the device's memory and in memory shared with it.
std::size_t layer_bytes(Kind kind, int side, Summing const& summing);

}  // namespace gpu_shading
