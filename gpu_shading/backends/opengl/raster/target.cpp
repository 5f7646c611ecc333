#include "backends/opengl/raster/target.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/framebuffer.h"

namespace gpu_shading {
namespace {

using Mode = gl::Readback::Mode;

constexpr glm::vec4 dark{0.0F};
constexpr glm::vec4 lit{1.0F};
constexpr glm::vec4 lit_without_key{0.0F, 0.0F, 0.0F, 1.0F};

void draw_receivers(Geometry& geometry, gl::Framebuffer const& target, glm::vec4 const& luminance) {
  target.bind();
  target.clear_colour(dark);
  gl::no_depth();
  gl::no_stencil();
  gl::blend(gl::Blend::replace);
  geometry.draw_tiles(luminance);
}

// 1 where a receiver is sunlit.
void draw_lit(Geometry& geometry, gl::Framebuffer const& target) {
  draw_receivers(geometry, target, lit);
  geometry.draw_casters();
}

// Receivers with luminance 1 and the casters in front of them, each of which multiplies by its
// transmittance (Jones & Greenberg). Multiplication commutes, so nothing is sorted.
void draw_luminance(Geometry& geometry, gl::Framebuffer const& target, glm::vec4 const& receivers,
                    gl::Blend how) {
  draw_receivers(geometry, target, receivers);
  gl::blend(how);
  geometry.draw_shades();
  gl::blend(gl::Blend::replace);
}

void draw_unscheduled(Geometry& geometry, gl::Framebuffer const& target) {
  draw_luminance(geometry, target, lit, gl::Blend::multiply);
}

std::size_t count_of(std::uint8_t value, std::span<std::uint8_t const> values) {
  // Byte lanes, used until they could overflow.
  constexpr std::size_t width = 32;
  constexpr std::size_t most = 255;
  std::size_t count = 0;
  while (values.size() >= width) {
    std::array<std::uint8_t, width> lanes{};
    std::size_t const rows = std::min(values.size() / width, most);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t lane = 0; lane < width; ++lane) {
        lanes[lane] =
            static_cast<std::uint8_t>(lanes[lane] + (values[row * width + lane] == value));
      }
    }
    count = std::accumulate(lanes.begin(), lanes.end(), count);
    values = values.subspan(rows * width);
  }
  return count + static_cast<std::size_t>(std::count(values.begin(), values.end(), value));
}

// The cheapest for llvmpipe to draw, by 9 % compared with a colour.
class StencilTarget : public Target {
 public:
  StencilTarget(int side, int layers)
      : texture_(gl::LayeredTexture::create(gl::Pixel::stencil, side, layers)),
        layers_(gl::Framebuffer::of_layers({&texture_})),
        pixels_(texture_, Mode::when_asked) {}

  void draw(Geometry& geometry, int layers, std::size_t /*parts*/) override {
    layers_.bind();
    gl::no_depth();
    // Sunlit pixels get a new mark each time, so that earlier marks need no clearing.
    if (++mark_ == 0) {
      layers_.clear_stencil();
      ++mark_;
    }
    gl::stencil(gl::Test::always, mark_, gl::OnPass::replace);
    geometry.draw_tiles(lit);
    gl::stencil(gl::Test::always, 0, gl::OnPass::replace);
    geometry.draw_casters();
    gl::no_stencil();
    pixels_.start(layers);
  }

  void read(int layer, std::span<LuminanceByKey> parts) override {
    parts.front()[{}] = static_cast<double>(count_of(mark_, pixels_.layer<std::uint8_t>(layer)));
  }

 private:
  gl::LayeredTexture texture_;
  gl::Framebuffer layers_;
  gl::Readback pixels_;
  std::uint8_t mark_ = 0xFF;
};

// To be summed by the device.
class SummedTarget : public Target {
 public:
  using Draw = void(Geometry& geometry, gl::Framebuffer const& target);

  SummedTarget(gl::LayeredTexture texture, Summing& summing, Draw* draw_to)
      : texture_(std::move(texture)),
        layers_(gl::Framebuffer::of_layers({&texture_})),
        reduction_(summing.make(texture_)),
        draw_to_(draw_to) {}

  void draw(Geometry& geometry, int layers, std::size_t /*parts*/) override {
    draw_to_(geometry, layers_);
    gl::Framebuffer::unbind();
    reduction_->start(layers);
  }

  void read(int layer, std::span<LuminanceByKey> parts) override {
    parts.front()[{}] = reduction_->sum(layer);
  }

 private:
  gl::LayeredTexture texture_;
  gl::Framebuffer layers_;
  std::unique_ptr<Reduction> reduction_;
  Draw* draw_to_;
};

class ScheduledTarget : public Target {
 public:
  ScheduledTarget(int side, int layers, Mode mode)
      : texture_(gl::LayeredTexture::create(gl::Pixel::reals, side, layers)),
        layers_(gl::Framebuffer::of_layers({&texture_})),
        pixels_(texture_, mode) {}

  void draw(Geometry& geometry, int layers, std::size_t /*parts*/) override {
    draw_luminance(geometry, layers_, lit_without_key, gl::Blend::multiply_and_add);
    pixels_.start(layers);
  }

  std::span<glm::vec4 const> pixels(int layer) { return pixels_.layer<glm::vec4>(layer); }

  void read(int layer, std::span<LuminanceByKey> parts) override {
    LuminanceSorter sorter(parts.front());
    for (glm::vec4 const& pixel : pixels(layer)) sorter.add(pixel);
  }

 private:
  gl::LayeredTexture texture_;
  gl::Framebuffer layers_;
  gl::Readback pixels_;
};

// The surface that the sun reaches first in each pixel of a window; 0: none. Among surfaces at the
// same depth, the first is used.
class Identities {
 public:
  Identities(int side, int layers)
      : texture_(gl::LayeredTexture::create(gl::Pixel::identity, side, layers)),
        depth_(gl::LayeredTexture::create(gl::Pixel::depth, side, layers)),
        layers_(gl::Framebuffer::of_layers({&texture_, &depth_})) {}

  gl::LayeredTexture const& texture() const { return texture_; }

  // Behind windows, except where casters close them, if these are wanted too.
  void draw(Geometry& geometry, bool casters) {
    // Nothing is nearer than 0: all pixels are closed except the window's, which are at the far
    // end.
    layers_.bind();
    gl::no_stencil();
    gl::blend(gl::Blend::replace);
    layers_.clear_identity();
    layers_.clear_depth(0.0F);
    gl::depth(gl::Test::always, true);
    gl::write_colour(false);
    geometry.draw_tiles(dark);
    if (casters) geometry.draw_casters();
    gl::write_colour(true);
    gl::depth(gl::Test::less, true);
    geometry.draw_interiors();
    gl::no_depth();
  }

 private:
  gl::LayeredTexture texture_;
  gl::LayeredTexture depth_;
  gl::Framebuffer layers_;
};

class InteriorTarget : public Target {
 public:
  InteriorTarget(int side, int layers, Summing& summing)
      : surfaces_(side, layers), counts_(summing.count(surfaces_.texture())) {}

  void draw(Geometry& geometry, int layers, std::size_t parts) override {
    surfaces_.draw(geometry, true);
    gl::Framebuffer::unbind();
    counts_->start(layers, parts);
  }

  void read(int layer, std::span<LuminanceByKey> parts) override {
    std::span<std::uint32_t const> const counts = counts_->counts(layer);
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i][{}] = counts[i];
  }

 private:
  Identities surfaces_;
  std::unique_ptr<IdentityCounts> counts_;
};

class ShadedInteriorTarget : public Target {
 public:
  ShadedInteriorTarget(int side, int layers, Mode mode)
      : luminance_(side, layers, mode),
        surfaces_(side, layers),
        pixels_(surfaces_.texture(), mode) {}

  void draw(Geometry& geometry, int layers, std::size_t parts) override {
    luminance_.draw(geometry, layers, parts);
    surfaces_.draw(geometry, false);
    pixels_.start(layers);
  }

  void read(int layer, std::span<LuminanceByKey> parts) override {
    std::span<glm::vec4 const> const luminance = luminance_.pixels(layer);
    std::span<std::uint32_t const> const identities = pixels_.layer<std::uint32_t>(layer);
    std::vector<LuminanceSorter> sorters(parts.begin(), parts.end());
    for (std::size_t i = 0; i < luminance.size(); ++i) {
      if (identities[i] > 0) sorters[identities[i] - 1].add(luminance[i]);
    }
  }

 private:
  ScheduledTarget luminance_;
  Identities surfaces_;
  gl::Readback pixels_;
};

std::size_t pixel_bytes(Kind kind) {
  std::size_t const identity = size_of(gl::Pixel::identity) + size_of(gl::Pixel::depth);
  switch (kind) {
    case Kind::unscheduled:
      return size_of(gl::Pixel::real);
    case Kind::scheduled:
      return size_of(gl::Pixel::reals);
    case Kind::interior:
      return identity;
    case Kind::shaded_interior:
      return size_of(gl::Pixel::reals) + identity;
    case Kind::opaque:
      break;
  }
  return size_of(gl::Pixel::unit);
}

}  // namespace

std::unique_ptr<Target> make_target(Kind kind, int side, int layers, Summing& summing) {
  Mode const mode = summing.mode();
  switch (kind) {
    case Kind::unscheduled:
      return std::make_unique<SummedTarget>(
          gl::LayeredTexture::create(gl::Pixel::real, side, layers), summing, draw_unscheduled);
    case Kind::scheduled:
      return std::make_unique<ScheduledTarget>(side, layers, mode);
    case Kind::interior:
      return std::make_unique<InteriorTarget>(side, layers, summing);
    case Kind::shaded_interior:
      return std::make_unique<ShadedInteriorTarget>(side, layers, mode);
    case Kind::opaque:
      break;
  }
  if (mode == Mode::when_asked) return std::make_unique<StencilTarget>(side, layers);
  return std::make_unique<SummedTarget>(gl::LayeredTexture::create(gl::Pixel::unit, side, layers),
                                        summing, draw_lit);
}

std::size_t layer_bytes(Kind kind, int side, Summing const& summing) {
  std::size_t const pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::size_t const bytes = pixels * pixel_bytes(kind);
  switch (kind) {
    case Kind::opaque:
    case Kind::unscheduled:
      return bytes + summing.extra_bytes(side);
    case Kind::interior:
      return bytes;
    case Kind::scheduled:
    case Kind::shaded_interior:
      break;
  }
  return summing.mode() == Mode::ahead ? 2 * bytes : bytes;
}

}  // namespace gpu_shading
