#include "render/coverage.h"

#include "gl/check.h"
#include "gl/draw.h"

namespace gpu_shading {

Coverage::Coverage(int resolution)
    : target_(gl::Framebuffer::create({gl::Format::stencil}, resolution, resolution)) {}

gl::Query const& Coverage::query(std::size_t index) {
  while (queries_.size() <= index) queries_.push_back(gl::Query::create());
  return queries_[index];
}

std::vector<Coverage::Count> Coverage::count(Geometry const& geometry, std::span<Job const> jobs) {
  target_.bind();
  gl::no_depth();
  // Each job marks what is covered with a value of its own, so that the marks of those before need
  // no clearing.
  constexpr std::size_t marks = 255;
  std::size_t used = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Job const& job = jobs[i];
    if (i % marks == 0) target_.clear_stencil();
    auto const mark = static_cast<std::uint8_t>(1 + i % marks);

    gl::cut_at_plane(true);
    gl::stencil(gl::Test::always, mark, gl::OnPass::replace);
    geometry.use_surfaces(geometry.surface_program());
    geometry.draw_surfaces(job.view, job.casters);

    gl::cut_at_plane(false);
    gl::stencil(gl::Test::not_equal, mark, gl::OnPass::keep);
    geometry.use_tiles();
    gl::Query const& lit = query(used++);
    lit.begin();
    geometry.draw_tile(job.tile);
    lit.end();
    if (job.count_receiver) {
      gl::no_stencil();
      gl::Query const& all = query(used++);
      all.begin();
      geometry.draw_tile(job.tile);
      all.end();
    }
  }

  std::vector<Count> counts(jobs.size());
  used = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    counts[i].lit = query(used++).wait_for_result();
    if (jobs[i].count_receiver) counts[i].receiver = query(used++).wait_for_result();
  }
  gl::check("drawing what the sun sees");
  return counts;
}

}  // namespace gpu_shading
