#include "render/coverage.h"

#include "gl/check.h"
#include "gl/draw.h"

namespace gpu_shading {

Coverage::Coverage(int side)
    : target_(gl::Framebuffer::create({gl::Format::stencil}, side, side)) {}

void Coverage::count_tile(Geometry const& geometry, Range tile) {
  if (queries_.size() == used_) queries_.push_back(gl::Query::create());
  gl::Query const& passed = queries_[used_++];
  geometry.use_tiles();
  passed.begin();
  geometry.draw_tile(tile);
  passed.end();
}

void Coverage::draw(Geometry const& geometry, std::span<ReceiverJob const> jobs) {
  target_.bind();
  gl::no_depth();
  used_ = 0;
  // Each job marks what is covered with a value of its own, so that the marks of those before need
  // no clearing.
  constexpr std::size_t marks = 255;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    ReceiverJob const& job = jobs[i];
    if (i % marks == 0) target_.clear_stencil();
    auto const mark = static_cast<std::uint8_t>(1 + i % marks);

    gl::cut_at_plane(true);
    gl::stencil(gl::Test::always, mark, gl::OnPass::replace);
    geometry.use_surfaces(geometry.surface_program());
    geometry.draw_surfaces(job.view, job.casters);

    gl::cut_at_plane(false);
    gl::stencil(gl::Test::not_equal, mark, gl::OnPass::keep);
    count_tile(geometry, job.tile);
  }
  gl::check("drawing what the sun sees");
}

void Coverage::draw_clear(Geometry const& geometry, std::span<Range const> tiles) {
  target_.bind();
  gl::no_depth();
  gl::no_stencil();
  gl::cut_at_plane(false);
  used_ = 0;
  for (Range const& tile : tiles) count_tile(geometry, tile);
  gl::check("drawing receivers");
}

std::vector<std::uint64_t> Coverage::counts() const {
  std::vector<std::uint64_t> counts;
  counts.reserve(used_);
  for (std::size_t i = 0; i < used_; ++i) counts.push_back(queries_[i].wait_for_result());
  gl::check("counting what the sun sees");
  return counts;
}

}  // namespace gpu_shading
