#include "render/luminance.h"

#include <algorithm>

#include "gl/check.h"

namespace gpu_shading {
namespace {

// OpenGL 4.5 has 2048 layers at least; these bound the memory.
constexpr std::size_t most_layers = 256;
constexpr std::size_t most_bytes = std::size_t{64} << 20U;

}  // namespace

void draw_luminance(Geometry& geometry, ReceiverJob const& job, gl::Blend how) {
  gl::no_stencil();
  gl::no_depth();
  gl::cut_at_plane(false);
  gl::blend(gl::Blend::replace);
  bool const keyed = how == gl::Blend::multiply_and_add;
  geometry.use_tiles_in(keyed ? glm::vec4(0.0F, 0.0F, 0.0F, 1.0F) : glm::vec4(1.0F));
  geometry.draw_tile(job.tile);
  gl::cut_at_plane(true);
  gl::blend(how);
  geometry.use_shades(job.first_key);
  geometry.draw_surfaces(job.view, job.casters);
  geometry.draw_screens(job.view, job.screens);
  gl::blend(gl::Blend::replace);
}

Luminance::Luminance(int side, LuminanceSum how)
    : side_(side), reduction_(make_reduction(how, side)) {}

void Luminance::make_layers(std::size_t wanted) {
  auto const pixels = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  std::size_t const most =
      std::clamp(most_bytes / (pixels * sizeof(float)), std::size_t{1}, most_layers);
  std::size_t const count = std::min(wanted, most);
  if (layers_.size() >= count) return;
  layers_.clear();
  texture_ = gl::LayeredTexture::create(side_, static_cast<int>(count), reduction_->levels());
  for (std::size_t i = 0; i < count; ++i) {
    layers_.push_back(gl::Framebuffer::of_layer(texture_, static_cast<int>(i)));
  }
}

void Luminance::draw(Geometry& geometry, std::span<ReceiverJob const> jobs) {
  make_layers(jobs.size());
  reduction_->begin(jobs.size());
  for (std::size_t begin = 0; begin < jobs.size(); begin += layers_.size()) {
    std::size_t const count = std::min(layers_.size(), jobs.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      layers_[i].bind();
      layers_[i].clear_colour(glm::vec4(0.0F));
      draw_luminance(geometry, jobs[begin + i], gl::Blend::multiply);
    }
    reduction_->add(texture_, static_cast<int>(count));
  }
  gl::check("drawing what the sun sees through shades");
}

}  // namespace gpu_shading
