#include "backends/opengl/raster/reduction.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

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
  ByCompute(gl::LayeredTexture const& texture, gl::Program const& squares, gl::Program& totals)
      : texture_(texture),
        squares_(squares),
        totals_(totals),
        of_a_layer_(square(squares_across(texture.side()))),
        sums_(gl::Buffer::create()),
        buffer_(gl::Buffer::create()) {
    auto const layers = static_cast<std::size_t>(texture.layers());
    sums_.set_size(layers * of_a_layer_ * sizeof(float));
    read_ = reinterpret_cast<double const*>(buffer_.set_shared_size(layers * sizeof(double)));
  }

  void start(int layers) override {
    squares_.use();
    texture_.bind(0);
    sums_.bind_storage(0);
    constexpr int group_side = 8;
    auto const groups =
        static_cast<std::uint32_t>((squares_across(texture_.side()) + group_side - 1) / group_side);
    gl::dispatch(groups, groups, static_cast<std::uint32_t>(layers));
    gl::share_between_programs();
    totals_.set(0, static_cast<std::uint32_t>(of_a_layer_));
    totals_.use();
    buffer_.bind_storage(1);
    gl::dispatch(static_cast<std::uint32_t>(layers), 1, 1);
    gl::share_written();
  }

  double sum(int layer) override { return read_[layer]; }

 private:
  gl::LayeredTexture const& texture_;
  gl::Program const& squares_;
  gl::Program& totals_;
  std::size_t of_a_layer_;
  gl::Buffer sums_;
  gl::Buffer buffer_;
  double const* read_;
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

class CountedByCompute : public IdentityCounts {
 public:
  CountedByCompute(gl::LayeredTexture const& texture, gl::Program& program)
      : texture_(texture), program_(program) {}

  void start(int layers, std::size_t most) override {
    most_ = most;
    std::size_t const bytes = static_cast<std::size_t>(layers) * most * sizeof(std::uint32_t);
    if (bytes > bytes_) {
      bytes_ = bytes;
      counts_ = gl::Buffer::create();
      counts_.set_size(bytes);
      buffer_ = gl::Buffer::create();
      read_ = reinterpret_cast<std::uint32_t const*>(buffer_.set_shared_size(bytes));
    }
    counts_.clear(bytes);
    program_.set(0, static_cast<std::uint32_t>(most));
    program_.use();
    texture_.bind(0);
    counts_.bind_storage(0);
    constexpr int group_side = 8;
    constexpr int run = 64;  // pixels of an invocation
    auto const groups = [&](int pixels) {
      return static_cast<std::uint32_t>((texture_.side() + pixels - 1) / pixels);
    };
    gl::dispatch(groups(group_side * run), groups(group_side), static_cast<std::uint32_t>(layers));
    gl::share_between_programs();
    counts_.copy_to(buffer_, bytes);
  }

  std::span<std::uint32_t const> counts(int layer) override {
    return {read_ + static_cast<std::size_t>(layer) * most_, most_};
  }

 private:
  gl::LayeredTexture const& texture_;
  gl::Program& program_;
  std::size_t most_ = 0;
  std::size_t bytes_ = 0;
  gl::Buffer counts_;
  gl::Buffer buffer_;
  std::uint32_t const* read_ = nullptr;
};

class CountedByReadback : public IdentityCounts {
 public:
  explicit CountedByReadback(gl::LayeredTexture const& texture)
      : pixels_(texture, gl::Readback::Mode::when_asked) {}

  void start(int layers, std::size_t most) override {
    counts_.resize(most + 1);
    pixels_.start(layers);
  }

  std::span<std::uint32_t const> counts(int layer) override {
    std::ranges::fill(counts_, 0U);
    for (std::uint32_t const identity : pixels_.layer<std::uint32_t>(layer)) ++counts_[identity];
    return std::span(counts_).subspan(1);
  }

 private:
  gl::Readback pixels_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace

std::size_t Summing::extra_bytes(int side) const {
  if (how_ == LuminanceSum::readback) return 0;
  return square(squares_across(side)) * sizeof(float) + sizeof(double);
}

std::unique_ptr<Reduction> Summing::make(gl::LayeredTexture const& texture) {
  if (how_ == LuminanceSum::readback) return std::make_unique<ByReadback>(texture);
  if (squares_.empty()) {
    squares_ = gl::Program::link_compute("sums", shaders::sum_comp);
    totals_ = gl::Program::link_compute("totals", shaders::total_comp);
  }
  return std::make_unique<ByCompute>(texture, squares_, totals_);
}

std::unique_ptr<IdentityCounts> Summing::count(gl::LayeredTexture const& texture) {
  if (how_ == LuminanceSum::readback) return std::make_unique<CountedByReadback>(texture);
  if (identities_.empty()) {
    identities_ = gl::Program::link_compute("identities", shaders::identities_comp);
  }
  return std::make_unique<CountedByCompute>(texture, identities_);
}

}  // namespace gpu_shading
