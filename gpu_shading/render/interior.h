#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gl/framebuffer.h"
#include "gl/query.h"
#include "render/draw_list.h"
#include "render/geometry.h"

namespace gpu_shading {

// Counts the pixels in which the sun reaches each interior surface through a window: the window's
// lit pixels are marked, the surfaces behind drawn twice, once to find the nearest depth and once
// to count who has it. For tiles of one side.
class Interior {
 public:
  explicit Interior(int side);

  // One count for each surface of the job, in order.
  std::vector<std::uint64_t> count(Geometry const& geometry, InteriorJob const& job);

 private:
  gl::Framebuffer target_;
  std::vector<gl::Query> queries_;
};

}  // namespace gpu_shading
