#include "render/reduction.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

#include "gl/buffer.h"
#include "gl/draw.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

// Lanes that do not wait for each other.
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

// Bytes that are 0 or 255: how many of the latter. Eight at a time, as many as a byte can count.
std::size_t count_of(std::span<std::uint8_t const> bytes) {
  constexpr std::uint64_t ones = 0x0101010101010101U;
  constexpr std::size_t word = sizeof(std::uint64_t);
  constexpr std::size_t block = 255 * word;
  std::size_t count = 0;
  std::size_t i = 0;
  while (i + word <= bytes.size()) {
    std::uint64_t counts = 0;
    std::size_t const end = std::min(bytes.size() / word * word, i + block);
    for (; i < end; i += word) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, bytes.data() + i, word);
      counts += eight & ones;
    }
    for (; counts != 0; counts >>= 8U) count += counts & 0xFFU;
  }
  for (; i < bytes.size(); ++i) count += bytes[i] & 1U;
  return count;
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

// 4^m times the sum over level m (Jones & Greenberg): the last that every pixel went into as one of
// four, its side what is left when the tile's is halved as often as it can be.
class ByMipmaps : public Reduction {
 public:
  explicit ByMipmaps(gl::LayeredTexture const& texture)
      : texture_(texture), coarsest_(texture, texture.levels() - 1, gl::Readback::Way::ahead) {}

  void start(int layers) override {
    texture_.make_mipmaps();
    coarsest_.start(layers);
  }

  double sum(int layer) override {
    return static_cast<double>(square(1 << (texture_.levels() - 1))) *
           sum_of(coarsest_.layer<float>(layer));
  }

 private:
  gl::LayeredTexture const& texture_;
  gl::Readback coarsest_;
};

class ByReadback : public Reduction {
 public:
  explicit ByReadback(gl::LayeredTexture const& texture)
      : of_bytes_(texture.pixel() == gl::Pixel::unit),
        pixels_(texture, 0, gl::Readback::Way::when_asked) {}

  void start(int layers) override { pixels_.start(layers); }

  double sum(int layer) override {
    return of_bytes_ ? static_cast<double>(count_of(pixels_.layer<std::uint8_t>(layer)))
                     : sum_of(pixels_.layer<float>(layer));
  }

 private:
  bool of_bytes_;
  gl::Readback pixels_;
};

}  // namespace

gl::LayeredTexture::Levels Summing::levels(gl::Pixel pixel) const {
  // Means of bytes are bytes.
  return how_ == LuminanceSum::mipmaps && pixel == gl::Pixel::real
             ? gl::LayeredTexture::Levels::all
             : gl::LayeredTexture::Levels::one;
}

std::size_t Summing::extra_bytes(gl::Pixel pixel, int side) const {
  if (how_ == LuminanceSum::readback) return 0;
  std::size_t const mipmaps =
      levels(pixel) == gl::LayeredTexture::Levels::all ? square(side) * size_of(pixel) / 3 : 0;
  return mipmaps + square(squares_across(side)) * sizeof(float);
}

std::unique_ptr<Reduction> Summing::make(gl::LayeredTexture const& texture) {
  if (how_ == LuminanceSum::readback) return std::make_unique<ByReadback>(texture);
  if (levels(texture.pixel()) == gl::LayeredTexture::Levels::all) {
    return std::make_unique<ByMipmaps>(texture);
  }
  if (squares_.empty()) squares_ = gl::Program::link_compute("sums", shaders::sum_comp);
  return std::make_unique<ByCompute>(texture, squares_);
}

}  // namespace gpu_shading
