#include "pictures/shadow_map.h"

#include <algorithm>

namespace gpu_shading {
namespace {

constexpr int max_size = 3000;
constexpr double behind_glass = 0.6;

// Whether a surface is in a pixel or one next to it, so that its own edge does not shade it.
bool is_near(std::vector<std::uint32_t> const& numbers, PictureGrid const& grid, int x, int y,
             std::uint32_t number) {
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, grid.height - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, grid.width - 1); ++column) {
      auto const at = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                      static_cast<std::size_t>(column);
      if (numbers[at] == number) return true;
    }
  }
  return false;
}

}  // namespace

ShadowMap::ShadowMap(PictureRaster& raster, std::span<SurfaceId const> shown, std::size_t opaque,
                     PictureFrame const& frame, SunAxes const& axes, glm::dvec3 const& origin,
                     double reach)
    : axes_(axes),
      origin_(origin),
      frame_(frame),
      grid_(make_grid(frame, axes, origin, reach, std::min(max_size, raster.max_pixels()))),
      nearest_(raster.nearest(grid_, shown)),
      nearest_opaque_(opaque < shown.size() ? raster.nearest(grid_, shown.first(opaque))
                                            : nearest_) {}

std::optional<ShadowMap::Pixel> ShadowMap::pixel_at(glm::dvec3 const& position) const {
  auto const at = axes_(position - origin_);
  auto const share = (at - frame_.low) / (frame_.high - frame_.low);
  if (share.x < 0.0 || share.y < 0.0 || share.x >= 1.0 || share.y >= 1.0) return std::nullopt;
  return Pixel{static_cast<int>(share.x * grid_.width), static_cast<int>(share.y * grid_.height)};
}

double ShadowMap::light(SurfaceId surface, glm::dvec3 const& position) const {
  auto const pixel = pixel_at(position);
  if (!pixel) return 1.0;
  auto const number = static_cast<std::uint32_t>(surface) + 1;
  if (is_near(nearest_, grid_, pixel->x, pixel->y, number)) return 1.0;
  return is_near(nearest_opaque_, grid_, pixel->x, pixel->y, number) ? behind_glass : 0.0;
}

double ShadowMap::light_on_ground(glm::dvec3 const& position) const {
  auto const pixel = pixel_at(position);
  if (!pixel) return 1.0;
  auto const at = static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(grid_.width) +
                  static_cast<std::size_t>(pixel->x);
  if (nearest_[at] == 0) return 1.0;
  return nearest_opaque_[at] == 0 ? behind_glass : 0.0;
}

}  // namespace gpu_shading
