#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gl/framebuffer.h"
#include "gl/query.h"
#include "render/draw_list.h"
#include "render/geometry.h"

namespace gpu_shading {

// Counts the pixels of receivers that opaque casters leave lit, by stencil and sample queries: one
// clear for every 255 receivers, nothing read back before the last is drawn.
class Coverage {
 public:
  explicit Coverage(int resolution);

  struct Job {
    std::size_t view = 0;
    Range casters;
    Range tile;
    bool count_receiver = false;  // its own pixels, too
  };
  struct Count {
    std::uint64_t lit = 0;
    std::uint64_t receiver = 0;  // 0 where not asked for
  };

  // One count for each job, in order. `geometry` holds the uploaded draw list.
  std::vector<Count> count(Geometry const& geometry, std::span<Job const> jobs);

 private:
  gl::Query const& query(std::size_t index);

  gl::Framebuffer target_;
  std::vector<gl::Query> queries_;
};

}  // namespace gpu_shading
