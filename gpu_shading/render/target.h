#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "render/geometry.h"
#include "render/luminance_by_key.h"
#include "render/reduction.h"

namespace gpu_shading {

// What is asked of a view, and so how it is drawn: the cheapest way that will do.
enum class Kind {
  opaque,           // lit pixels counted: 1 where the receiver is, 0 where a caster is before it
  unscheduled,      // luminance in 32 bits, which every caster multiplies by what it lets through
  scheduled,        // beside it the sum of the keys of the schedules passed
  interior,         // lit pixels of a window by the surface that the sun reaches behind it
  shaded_interior,  // the luminance of these, and keys
};

// Layers to draw views of one kind to, on tiles of one side, and the way of what is asked for back.
class Target {
 public:
  virtual ~Target() = default;

  // What `geometry` holds, views from layer 0 on. Nothing waits.
  virtual void draw(Geometry& geometry, int layers) = 0;
  // When that is done: sums of a layer's luminance, of a window by the surface behind it.
  virtual void read(int layer, std::span<LuminanceByKey> parts) = 0;
};

// Throws DeviceError when there is no memory for it.
std::unique_ptr<Target> make_target(Kind kind, int side, int layers, Summing& summing);

// Of a layer, in the device's memory and in that shared with it.
std::size_t layer_bytes(Kind kind, int side, Summing const& summing);

}  // namespace gpu_shading
