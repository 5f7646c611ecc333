#include "render/interior.h"

#include "gl/check.h"
#include "gl/draw.h"

namespace gpu_shading {

Interior::Interior(int side)
    : target_(gl::Framebuffer::create({gl::Format::depth_stencil}, side, side)) {}

std::vector<std::uint64_t> Interior::count(Geometry const& geometry, InteriorJob const& job) {
  while (queries_.size() < job.surfaces.size()) queries_.push_back(gl::Query::create());

  target_.bind();
  gl::depth(gl::Test::less, true);
  target_.clear_depth();
  target_.clear_stencil();
  gl::no_depth();

  constexpr std::uint8_t untouched = 0;
  constexpr std::uint8_t covered = 1;
  constexpr std::uint8_t lit = 0xFF;
  gl::cut_at_plane(true);
  gl::stencil(gl::Test::always, covered, gl::OnPass::replace);
  geometry.use_surfaces(geometry.surface_program());
  geometry.draw_surfaces(job.window.view, job.window.casters);

  gl::cut_at_plane(false);
  geometry.use_tiles();
  gl::stencil(gl::Test::equal, untouched, gl::OnPass::invert);
  geometry.draw_tile(job.window.tile);

  gl::cut_at_plane(true);
  geometry.use_surfaces(geometry.surface_program());
  gl::stencil(gl::Test::equal, lit, gl::OnPass::keep);
  gl::depth(gl::Test::less, true);
  for (Range const& surface : job.surfaces) geometry.draw_surfaces(job.behind_view, surface);

  // A pixel once counted is no longer lit: where surfaces coincide the first takes it.
  gl::stencil(gl::Test::equal, lit, gl::OnPass::zero);
  gl::depth(gl::Test::equal, false);
  for (std::size_t i = 0; i < job.surfaces.size(); ++i) {
    queries_[i].begin();
    geometry.draw_surfaces(job.behind_view, job.surfaces[i]);
    queries_[i].end();
  }

  std::vector<std::uint64_t> counts;
  for (std::size_t i = 0; i < job.surfaces.size(); ++i) {
    counts.push_back(queries_[i].wait_for_result());
  }
  gl::check("drawing what the sun sees through a window");
  return counts;
}

}  // namespace gpu_shading
