#include "filters/perforation/image_rays.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace gpu_shading {
namespace {

// Avoids a call, which std::floor is on older processors.
double round_down(double x) {
  auto const whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1.0 : whole;
}

// The two texels around a position in a row or column that repeats, and the distance from the
// first.
struct Between {
  std::size_t below;
  std::size_t above;
  float part;

  Between(double place, std::size_t count) {
    double const from_middles = place + 0.5;
    auto const whole = static_cast<std::int64_t>(from_middles);
    auto const next = static_cast<std::size_t>(whole);
    below = next > 0 ? next - 1 : count - 1;
    above = next < count ? next : 0;
    part = static_cast<float>(from_middles - static_cast<double>(whole));
  }
};

}  // namespace

ImageRays::ImageRays(OpacityTile const& image, SheetInBeam const& sheet,
                     std::vector<double> const& depths)
    : image_(&image),
      cells_(sheet.cells.get()),
      threshold_(sheet.threshold),
      tile_(sheet.tile),
      size_(image.columns(), image.rows()) {
  glm::dvec2 const ray_offset(sheet.ray_offset);
  layers_.reserve(depths.size());
  for (double const depth : depths) layers_.push_back(in_image(depth * ray_offset));
}

glm::dvec2 ImageRays::in_image(glm::dvec2 const& place) const {
  glm::dvec2 const tiles = place / tile_;
  return size_ * glm::dvec2(tiles.x - round_down(tiles.x), tiles.y - round_down(tiles.y));
}

// Bilinear, like sampling a repeating texture.
float ImageRays::opacity(glm::dvec2 const& texel) const {
  auto const columns = static_cast<std::size_t>(image_->columns());
  Between const x(texel.x, columns);
  Between const y(texel.y, static_cast<std::size_t>(image_->rows()));
  std::uint16_t const* const texels = image_->opacity().data();
  std::uint16_t const* const low = texels + columns * y.below;
  std::uint16_t const* const high = texels + columns * y.above;
  float const below = mix(low[x.below], low[x.above], x.part);
  float const above = mix(high[x.below], high[x.above], x.part);
  return mix(below, above, y.part) * (1.0F / 65535.0F);
}

float ImageRays::solid(float opacity) const {
  if (threshold_ < 0.0F) return opacity;
  return opacity > threshold_ ? 1.0F : 0.0F;
}

float ImageRays::solid_at(glm::dvec2 const& place) const { return solid(opacity(in_image(place))); }

float ImageRays::through(glm::dvec2 const& place) const {
  glm::dvec2 const start = in_image(place);
  float most = 0.0F;
  for (glm::dvec2 const& layer : layers_) {
    glm::dvec2 texel = start + layer;
    if (texel.x >= size_.x) texel.x -= size_.x;
    if (texel.y >= size_.y) texel.y -= size_.y;
    most = std::max(most, solid(opacity(texel)));
    if (most >= 1.0F) break;
  }
  return 1.0F - most;
}

ImageCells::Known ImageRays::known(glm::dvec2 const& first, glm::dvec2 const& step,
                                   std::uint64_t wanted) const {
  if (cells_ == nullptr) return {0, 0};
  ImageCells::Known const found = cells_->find(first, step, tile_);
  return {found.open & wanted, found.solid & wanted};
}

namespace {

// Calls use(number) for the bits that are set.
template <typename Use>
void each_ray(std::uint64_t bits, Use use) {
  for (; bits != 0; bits &= bits - 1) use(std::countr_zero(bits));
}

}  // namespace

void ImageRays::find_through(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                             Passed& passed) const {
  ImageCells::Known const found = known(first, step, wanted);
  float const nothing = 1.0F - solid(OpacityTile::solid_texel * (1.0F / 65535.0F));
  for (std::size_t i = 0; i < passed.size(); ++i) {
    passed[i] = (found.open >> i & 1U) != 0 ? 1.0F : nothing;
  }
  each_ray(wanted & ~found.open & ~found.solid, [&](int ray) {
    passed[static_cast<std::size_t>(ray)] = through(first + static_cast<double>(ray) * step);
  });
}

std::uint64_t ImageRays::passing(glm::dvec2 const& first, glm::dvec2 const& step,
                                 std::uint64_t wanted) const {
  ImageCells::Known const found = known(first, step, wanted);
  std::uint64_t passing = found.open;
  each_ray(wanted & ~found.open & ~found.solid, [&](int ray) {
    if (through(first + static_cast<double>(ray) * step) > 0.0F) {
      passing |= std::uint64_t{1} << static_cast<unsigned>(ray);
    }
  });
  return passing;
}

}  // namespace gpu_shading
