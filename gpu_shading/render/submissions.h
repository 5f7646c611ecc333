#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gl/fence.h"
#include "gpu_shading/renderer.h"
#include "render/draw_list.h"
#include "render/geometry.h"
#include "render/luminance_by_key.h"
#include "render/target_pool.h"
#include "render/transmission.h"

namespace gpu_shading {

// Views on their way through the device. They are gathered by kind and side until there are as many
// as a target has layers, or until all that is gathered takes too much memory; then they are
// submitted, and while the device draws the next are gathered. Answers come back in order.
class Submissions {
 public:
  // What it refers to must outlive it. Adds to the statistics' seconds of submitting, waiting and
  // reading.
  Submissions(Geometry& geometry, Transmission const& transmission, Bounds const& bounds,
              LuminanceSum how, RendererStatistics& statistics)
      : geometry_(geometry),
        transmission_(transmission),
        most_in_flight_(bounds.in_flight),
        targets_(bounds, how),
        statistics_(statistics) {}

  // Adds a view to a list, on a layer.
  using Gather = std::function<void(DrawList& list, int layer)>;
  // Answered by so many sums. Returns the view's number.
  std::size_t add(Kind kind, int side, std::size_t parts, Gather const& gather);

  // Submits the rest and waits for all of it.
  void finish();
  // Of a view by its number, after finish().
  std::span<LuminanceByKey const> sums(std::size_t view) const;

  // Forgets all views, those under way too.
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
  std::size_t most_in_flight_;
  TargetPool targets_;
  RendererStatistics& statistics_;
  std::map<Group, Batch> gathered_;
  std::deque<InFlight> in_flight_;
  std::vector<Range> views_;  // of sums_
  std::vector<LuminanceByKey> sums_;
};

}  // namespace gpu_shading
