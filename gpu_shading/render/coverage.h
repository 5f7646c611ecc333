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
// clear for every 255 receivers, nothing read back before it is asked for. For tiles of one side.
class Coverage {
 public:
  explicit Coverage(int side);

  // Draws from the draw list that `geometry` holds.
  void draw(Geometry const& geometry, std::span<ReceiverJob const> jobs);
  // The same of tiles that nothing shades.
  void draw_clear(Geometry const& geometry, std::span<Range const> tiles);

  // What was last drawn, a count of pixels for each job or tile in order. Waits for it.
  std::vector<std::uint64_t> counts() const;

 private:
  void count_tile(Geometry const& geometry, Range tile);

  gl::Framebuffer target_;
  std::vector<gl::Query> queries_;
  std::size_t used_ = 0;  // of the queries
};

}  // namespace gpu_shading
