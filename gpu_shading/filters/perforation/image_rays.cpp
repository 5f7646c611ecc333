#include "filters/perforation/image_rays.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace gpu_shading {
namespace {

// The texel before another in a row or column that repeats.
std::size_t before(std::uint32_t texel, std::uint32_t count) {
  return texel > 0 ? texel - 1 : count - 1;
}

}  // namespace

ImageRays::ImageRays(OpacityTile const& image, SheetInBeam const& sheet,
                     std::vector<double> const& depths)
    : image_(&image),
      cells_(sheet.cells.get()),
      threshold_(sheet.threshold),
      tile_(sheet.tile),
      size_(image.columns(), image.rows()),
      half_texel_(0.5 * tile_ / glm::dvec2(size_)) {
  glm::dvec2 const ray_offset(sheet.ray_offset);
  layers_.reserve(depths.size());
  for (double const depth : depths) layers_.push_back(part_of_tile(depth * ray_offset / tile_));
}

// Bilinear, like sampling a repeating texture.
float ImageRays::opacity(glm::uvec2 const& position) const {
  PlaceInTile const x(position.x, size_.x);
  PlaceInTile const y(position.y, size_.y);
  std::size_t const left = before(x.part, size_.x);
  std::uint16_t const* const texels = image_->opacity().data();
  std::uint16_t const* const low = texels + std::size_t{size_.x} * before(y.part, size_.y);
  std::uint16_t const* const high = texels + std::size_t{size_.x} * y.part;
  float const below = mix(low[left], low[x.part], x.rest);
  float const above = mix(high[left], high[x.part], x.rest);
  return mix(below, above, y.rest) * (1.0F / 65535.0F);
}

float ImageRays::solid(float opacity) const {
  if (threshold_ < 0.0F) return opacity;
  return opacity > threshold_ ? 1.0F : 0.0F;
}

float ImageRays::solid_at(glm::dvec2 const& place) const { return solid(opacity(position(place))); }

float ImageRays::through(glm::uvec2 const& position) const {
  float most = 0.0F;
  for (glm::uvec2 const& layer : layers_) {
    most = std::max(most, solid(opacity(position + layer)));
    if (most >= 1.0F) break;
  }
  return 1.0F - most;
}

std::shared_ptr<ImageCells const> ImageRays::make_cells(ImageBounds const& bounds) const {
  std::vector<glm::dvec2> in_texels;
  in_texels.reserve(layers_.size());
  for (glm::uvec2 const& layer : layers_) {
    in_texels.push_back(glm::dvec2(layer) * 0x1p-32 * glm::dvec2(size_));
  }
  return std::make_shared<ImageCells const>(bounds, in_texels);
}

ImageCells::Known ImageRays::known(TilePositions const& rays, std::uint64_t wanted) const {
  if (cells_ == nullptr) return {0, 0};
  ImageCells::Known const found = cells_->find(rays);
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
  TilePositions const rays(first + half_texel_, step, tile_);
  ImageCells::Known const found = known(rays, wanted);
  float const nothing = 1.0F - solid(OpacityTile::solid_texel * (1.0F / 65535.0F));
  for (std::size_t i = 0; i < passed.size(); ++i) {
    passed[i] = (found.open >> i & 1U) != 0 ? 1.0F : nothing;
  }
  each_ray(wanted & ~found.open & ~found.solid, [&](int ray) {
    passed[static_cast<std::size_t>(ray)] = through(rays[static_cast<std::uint32_t>(ray)]);
  });
}

std::uint64_t ImageRays::passing(glm::dvec2 const& first, glm::dvec2 const& step,
                                 std::uint64_t wanted) const {
  TilePositions const rays(first + half_texel_, step, tile_);
  ImageCells::Known const found = known(rays, wanted);
  std::uint64_t passing = found.open;
  each_ray(wanted & ~found.open & ~found.solid, [&](int ray) {
    if (through(rays[static_cast<std::uint32_t>(ray)]) > 0.0F) {
      passing |= std::uint64_t{1} << static_cast<unsigned>(ray);
    }
  });
  return passing;
}

}  // namespace gpu_shading
