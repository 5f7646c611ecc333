#include "backends/opengl/raster/reduction.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/draw.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

// Independent lanes.
double sum_of(std::span<float const> values) {
  std::array<double, 8> lanes{};
  std::size_t i = 0;
  for (; i + lanes.size() <= values.size(); i += lanes.size()) {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      lanes[lane] += static_cast<double>(values[i + lane]);
    }
  }
  for (; i < values.size(); ++i) lanes[0] += static_cast<double>(values[i]);
  return std::accumulate(lanes.begin(), lanes.end(), 0.0);
}

int squares_across(int side) {
  constexpr int square_side = 16;  // as in sum.comp
  return (side + square_side - 1) / square_side;
}

std::size_t square(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

class ByCompute : public Reduction {
 public:
  ByCompute(gl::LayeredTexture const& texture, gl::Program const& program)
      : texture_(texture),
        program_(program),
        of_a_layer_(square(squares_across(texture.side()))),
        buffer_(gl::Buffer::create()) {
    sums_ = reinterpret_cast<float const*>(buffer_.set_shared_size(
        static_cast<std::size_t>(texture.layers()) * of_a_layer_ * sizeof(float)));
  }

  void start(int layers) override {
    program_.use();
    texture_.bind(0);
    buffer_.bind_storage(0);
    constexpr int group_side = 8;
    auto const groups =
        static_cast<std::uint32_t>((squares_across(texture_.side()) + group_side - 1) / group_side);
    gl::dispatch(groups, groups, static_cast<std::uint32_t>(layers));
    gl::share_written();
  }

  double sum(int layer) override {
    return sum_of({sums_ + static_cast<std::size_t>(layer) * of_a_layer_, of_a_layer_});
  }

 private:
  gl::LayeredTexture const& texture_;
  gl::Program const& program_;
  std::size_t of_a_layer_;
  gl::Buffer buffer_;
  float const* sums_;
};

class ByReadback : public Reduction {
 public:
  explicit ByReadback(gl::LayeredTexture const& texture)
      : pixels_(texture, gl::Readback::Mode::when_asked) {}

  void start(int layers) override { pixels_.start(layers); }
  double sum(int layer) override { return sum_of(pixels_.layer<float>(layer)); }

 private:
  gl::Readback pixels_;
};

}  // namespace

std::size_t Summing::extra_bytes(int side) const {
  if (how_ == LuminanceSum::readback) return 0;
  return square(squares_across(side)) * sizeof(float);
}

std::unique_ptr<Reduction> Summing::make(gl::LayeredTexture const& texture) {
  if (how_ == LuminanceSum::readback) return std::make_unique<ByReadback>(texture);
  if (squares_.empty()) squares_ = gl::Program::link_compute("sums", shaders::sum_comp);
  return std::make_unique<ByCompute>(texture, squares_);
}

}  // namespace gpu_shading
