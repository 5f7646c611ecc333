#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "backends/opengl/gl/readback.h"
#include "backends/opengl/raster/draw_list.h"
#include "backends/opengl/raster/geometry.h"
#include "backends/opengl/raster/schedule_keys.h"
#include "backends/opengl/raster/target_pool.h"
#include "filters/transmission.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// Views being drawn on the device. They are collected by kind and side until there are as many as a
// target has layers, or until they take too much memory. Then they are submitted, and the next ones
// are collected while the device draws. Answers come back in order.
class Submissions {
 public:
  // Referenced objects must outlive it. Adds to the statistics' seconds of submitting, waiting and
  // reading.
  Submissions(Geometry& geometry, Transmission const& transmission, Bounds const& bounds,
              LuminanceSum how, RendererStatistics& statistics)
      : geometry_(geometry),
        transmission_(transmission),
        max_in_flight_(bounds.in_flight),
        targets_(bounds, how),
        statistics_(statistics) {}

  // Adds a view to a list, on a layer.
  using Gather = std::function<void(DrawList& list, int layer)>;
  // The view is answered by this many sums. Returns the view's index.
  std::size_t add(Kind kind, int side, std::size_t parts, Gather const& gather);

  // Submits the remaining views and waits for all of them.
  void finish();
  // The sums of a view by its index, after finish().
  std::span<LuminanceByKey const> sums(std::size_t view) const;

  // Discards all views, including those being drawn.
  void clear();

 private:
  using Group = std::pair<Kind, int>;  // kind and side
  struct Batch {
    DrawList list;
    std::vector<Range> answers;  // of sums_, by layer
  };
  struct InFlight {
    Target* target;
    std::vector<Range> answers;
    gl::Fence fence;
  };

  void submit(Group const& group, Batch& batch);
  void submit_largest();
  void collect();

  Geometry& geometry_;
  Transmission const& transmission_;
  std::size_t max_in_flight_;
  TargetPool targets_;
  RendererStatistics& statistics_;
  std::map<Group, Batch> gathered_;
  std::deque<InFlight> in_flight_;
  std::vector<Range> views_;  // of sums_
  std::vector<LuminanceByKey> sums_;
};

}  // namespace gpu_shading
