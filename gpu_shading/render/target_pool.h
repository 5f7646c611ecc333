#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

#include "render/target.h"

namespace gpu_shading {

// Of what a renderer has under way on its device.
struct Bounds {
  std::size_t in_flight = 1;    // submissions
  std::size_t target = 0;       // bytes of a target, or one layer where that is more
  std::size_t all_targets = 0;  // or one layer in flight where that is more
  int layers = 1;               // of a target
};

// Targets on a device, kept for the next views of their kind and side. Bounds the memory that they
// take: a target is of as many layers as were needed at a time, and those longest not drawn to go
// first.
class TargetPool {
 public:
  TargetPool(Bounds const& bounds, LuminanceSum how) : bounds_(bounds), summing_(how) {}

  // Views of this kind that may be drawn at once.
  int most_layers(Kind kind, int side) const;

  // One to draw to, from when it is taken until it is given back; nothing when those that are taken
  // leave no memory.
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
