#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

#include "backends/opengl/raster/target.h"

namespace gpu_shading {

// Limits of the work under way on a renderer's device.
struct Bounds {
  std::size_t in_flight = 1;    // submissions
  std::size_t target = 0;       // bytes of a target, or of one layer if that is more
  std::size_t all_targets = 0;  // or one layer in flight if that is more
  int layers = 1;               // of a target
};

// Targets on a device, kept for later views of the same kind and side. Bounds their memory: a
// target has as many layers as were needed at a time, and the least recently drawn targets are
// evicted first.
class TargetPool {
 public:
  TargetPool(Bounds const& bounds, LuminanceSum how) : bounds_(bounds), summing_(how) {}

  // Number of views of this kind that may be drawn at once.
  int max_layers(Kind kind, int side) const;

  // A target to draw to, which is taken until it is given back; empty if the targets in use leave
  // no memory.
  Target* take(Kind kind, int side, int layers);
  void give_back(Target const* target);
  void give_all_back();

 private:
  struct Entry {
    Kind kind;
    int side;
    int layers;
    std::size_t bytes;
    std::unique_ptr<Target> target;
    bool taken = false;
    std::uint64_t last_taken = 0;
  };

  Entry* find(Kind kind, int side, int layers);
  bool make_room(std::size_t bytes);

  Bounds bounds_;
  Summing summing_;
  std::list<Entry> entries_;
  std::uint64_t taken_ = 0;  // so far
};

}  // namespace gpu_shading
