#include "render/reduction.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>

#include "gl/buffer.h"
#include "gl/check.h"
#include "gl/draw.h"
#include "gl/program.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

// Leaves some floats of each layer in a buffer, to be summed in double precision here.
class PartialSums : public Reduction {
 public:
  explicit PartialSums(std::size_t of_a_layer)
      : of_a_layer_(of_a_layer), buffer_(gl::Buffer::create()) {}

  void begin(std::size_t layers) override {
    layers_ = 0;
    if (layers <= room_) return;
    buffer_.set_size(layers * of_a_layer_ * sizeof(float));
    room_ = layers;
  }

  void add(gl::LayeredTexture const& luminance, int layers) override {
    write(luminance, layers, layers_ * of_a_layer_);
    layers_ += static_cast<std::size_t>(layers);
  }

  std::vector<double> sums() const override {
    std::vector<float> const parts = buffer_.read_floats(layers_ * of_a_layer_);
    gl::check("summing luminance");
    std::vector<double> sums;
    for (std::size_t layer = 0; layer < layers_; ++layer) {
      auto const first = parts.begin() + static_cast<std::ptrdiff_t>(layer * of_a_layer_);
      sums.push_back(weight() *
                     std::accumulate(first, first + static_cast<std::ptrdiff_t>(of_a_layer_), 0.0));
    }
    return sums;
  }

 protected:
  virtual void write(gl::LayeredTexture const& luminance, int layers, std::size_t first) = 0;
  virtual double weight() const { return 1.0; }  // of a float

  gl::Buffer const& buffer() const { return buffer_; }

 private:
  std::size_t of_a_layer_;
  std::size_t layers_ = 0;
  std::size_t room_ = 0;
  gl::Buffer buffer_;
};

std::size_t square(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

class ByCompute : public PartialSums {
 public:
  explicit ByCompute(int side)
      : PartialSums(square(squares_across(side))),
        program_(gl::Program::link_compute("sums", shaders::sum_comp)) {}

  gl::LayeredTexture::Levels levels() const override { return gl::LayeredTexture::Levels::one; }

 private:
  // As in sum.comp.
  static int squares_across(int side) {
    constexpr int square_side = 16;
    return (side + square_side - 1) / square_side;
  }

  void write(gl::LayeredTexture const& luminance, int layers, std::size_t first) override {
    program_.set(0, static_cast<std::uint32_t>(first));
    program_.use();
    luminance.bind(0);
    buffer().bind_storage(0);
    constexpr int group_side = 8;
    auto const groups = static_cast<std::uint32_t>(
        (squares_across(luminance.side()) + group_side - 1) / group_side);
    gl::dispatch(groups, groups, static_cast<std::uint32_t>(layers));
  }

  gl::Program program_;
};

// 4^m times the sum over level m (Jones & Greenberg): the last that every pixel went into as one of
// four, its side what is left when the tile's is halved as often as it can be.
class ByMipmaps : public PartialSums {
 public:
  explicit ByMipmaps(int side) : PartialSums(square(odd_part(side))), weight_(weight_of(side)) {}

  gl::LayeredTexture::Levels levels() const override { return gl::LayeredTexture::Levels::all; }

 private:
  static int odd_part(int side) {
    while (side % 2 == 0) side /= 2;
    return side;
  }
  static double weight_of(int side) {
    return static_cast<double>(square(side)) / static_cast<double>(square(odd_part(side)));
  }

  void write(gl::LayeredTexture const& luminance, int layers, std::size_t first) override {
    luminance.make_mipmaps();
    luminance.copy_level(luminance.levels() - 1, layers, buffer(), first * sizeof(float));
  }
  double weight() const override { return weight_; }

  double weight_;
};

// Where device memory is the CPU's own.
class ByReadback : public Reduction {
 public:
  gl::LayeredTexture::Levels levels() const override { return gl::LayeredTexture::Levels::one; }

  void begin(std::size_t) override { sums_.clear(); }

  void add(gl::LayeredTexture const& luminance, int layers) override {
    std::size_t const pixels = square(luminance.side());
    pixels_.resize(pixels * static_cast<std::size_t>(layers));
    luminance.read(layers, pixels_);
    for (std::size_t first = 0; first < pixels_.size(); first += pixels) {
      sums_.push_back(sum({pixels_.data() + first, pixels}));
    }
  }

  std::vector<double> sums() const override {
    gl::check("summing luminance");
    return sums_;
  }

 private:
  static double sum(std::span<float const> pixels) {
    // Lanes that do not wait for each other.
    std::array<double, 8> lanes{};
    std::size_t i = 0;
    for (; i + lanes.size() <= pixels.size(); i += lanes.size()) {
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        lanes[lane] += static_cast<double>(pixels[i + lane]);
      }
    }
    for (; i < pixels.size(); ++i) lanes[0] += static_cast<double>(pixels[i]);
    return std::accumulate(lanes.begin(), lanes.end(), 0.0);
  }

  std::vector<float> pixels_;
  std::vector<double> sums_;
};

}  // namespace

std::unique_ptr<Reduction> make_reduction(LuminanceSum how, int side) {
  switch (how) {
    case LuminanceSum::mipmaps:
      return std::make_unique<ByMipmaps>(side);
    case LuminanceSum::readback:
      return std::make_unique<ByReadback>();
    case LuminanceSum::automatic:
    case LuminanceSum::compute:
      break;
  }
  return std::make_unique<ByCompute>(side);
}

}  // namespace gpu_shading
