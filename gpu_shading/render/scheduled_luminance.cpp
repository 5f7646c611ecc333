#include "render/scheduled_luminance.h"

#include <algorithm>

#include "gl/check.h"
#include "gl/draw.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20U;

// Neighbouring pixels mostly have the same key: it is looked up where it changes.
class Sorter {
 public:
  explicit Sorter(LuminanceByKey& sums) : sums_(sums) {}

  void add(glm::vec4 const& pixel) {
    if (pixel.a == 0.0F) return;
    if (sum_ == nullptr || pixel.r != last_.r || pixel.g != last_.g || pixel.b != last_.b) {
      sum_ = &sums_[{static_cast<std::uint32_t>(pixel.r), static_cast<std::uint32_t>(pixel.g),
                     static_cast<std::uint32_t>(pixel.b)}];
      last_ = pixel;
    }
    *sum_ += static_cast<double>(pixel.a);
  }

 private:
  LuminanceByKey& sums_;
  glm::vec4 last_{0.0F};
  double* sum_ = nullptr;
};

void draw_keyed(Geometry& geometry, gl::Framebuffer const& target, ReceiverJob const& job) {
  target.bind();
  target.clear_colour(glm::vec4(0.0F));
  draw_luminance(geometry, job, gl::Blend::multiply_and_add);
}

}  // namespace

ScheduledLuminance::ScheduledLuminance(int side) : side_(side) {}

std::vector<LuminanceByKey> ScheduledLuminance::sum(Geometry& geometry,
                                                    std::span<ReceiverJob const> jobs) {
  auto const across = static_cast<std::size_t>(side_);
  std::size_t const most =
      std::max<std::size_t>(1, most_bytes / (across * across * sizeof(glm::vec4)));
  while (targets_.size() < std::min(most, jobs.size())) {
    targets_.push_back(gl::Framebuffer::create({gl::Format::precise_colour}, side_, side_));
  }
  std::vector<LuminanceByKey> sums(jobs.size());
  for (std::size_t begin = 0; begin < jobs.size(); begin += targets_.size()) {
    std::size_t const count = std::min(targets_.size(), jobs.size() - begin);
    for (std::size_t i = 0; i < count; ++i) draw_keyed(geometry, targets_[i], jobs[begin + i]);
    for (std::size_t i = 0; i < count; ++i) {
      Sorter sorter(sums[begin + i]);
      targets_[i].read_precise_colour(pixels_);
      for (glm::vec4 const& pixel : pixels_) sorter.add(pixel);
    }
  }
  gl::check("drawing what the sun sees through scheduled shades");
  return sums;
}

InteriorLuminance::InteriorLuminance(int side)
    : program_(gl::Program::link("identities", shaders::slide_vert, shaders::identity_frag)),
      luminance_(gl::Framebuffer::create({gl::Format::precise_colour}, side, side)),
      nearest_(
          gl::Framebuffer::create({gl::Format::identity, gl::Format::depth_stencil}, side, side)) {}

std::vector<LuminanceByKey> InteriorLuminance::sum(Geometry& geometry, InteriorJob const& job) {
  draw_keyed(geometry, luminance_, job.window);

  nearest_.bind();
  gl::no_stencil();
  gl::depth(gl::Test::less, true);
  nearest_.clear_depth();
  nearest_.clear_identity();
  gl::cut_at_plane(true);
  for (std::size_t i = 0; i < job.surfaces.size(); ++i) {
    program_.set(0, static_cast<std::uint32_t>(i + 1));
    geometry.use_surfaces(program_);
    geometry.draw_surfaces(job.behind_view, job.surfaces[i]);
  }
  gl::no_depth();

  std::vector<glm::vec4> luminance;
  luminance_.read_precise_colour(luminance);
  std::vector<std::uint32_t> const nearest = nearest_.read_identity();
  std::vector<LuminanceByKey> sums(job.surfaces.size());
  std::vector<Sorter> sorters(sums.begin(), sums.end());
  for (std::size_t i = 0; i < luminance.size(); ++i) {
    if (nearest[i] > 0) sorters[nearest[i] - 1].add(luminance[i]);
  }
  gl::check("drawing what the sun sees through a window behind shades");
  return sums;
}

}  // namespace gpu_shading
