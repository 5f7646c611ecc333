#include "filters/perforation/region_rays.h"

#include <cstddef>
#include <cstdint>

#include "filters/perforation/image_rays.h"
#include "filters/perforation/tile_positions.h"
#include "platform/instructions.h"

namespace gpu_shading {
namespace {

using Passed = PatternRays::Passed;

struct Regions {
  float const* passed;  // of whole paths, each row followed by its first again, and so the rows
  std::uint32_t across;
  std::uint32_t up;
};

// Written so that the compiler can vectorise over rays.
[[gnu::always_inline]] inline void interpolate(Regions const& regions, TilePositions const& rays,
                                               Passed& passed) {
  auto const stride = static_cast<std::int32_t>(regions.across) + 1;
  for (std::uint32_t i = 0; i < PatternRays::most; ++i) {
    PlaceInTile const x(rays.first.x + i * rays.step.x, regions.across);
    PlaceInTile const y(rays.first.y + i * rays.step.y, regions.up);
    std::int32_t const at =
        static_cast<std::int32_t>(y.part) * stride + static_cast<std::int32_t>(x.part);
    float const below = mix(regions.passed[at], regions.passed[at + 1], x.rest);
    float const above = mix(regions.passed[at + stride], regions.passed[at + stride + 1], x.rest);
    passed[i] = mix(below, above, y.rest);
  }
}

}  // namespace

void find_by_region(SheetInBeam const& sheet, glm::dvec2 const& first, glm::dvec2 const& step,
                    Passed& passed) {
  glm::dvec2 const tile(sheet.tile);
  glm::dvec2 const half_region = 0.5 * tile / glm::dvec2(sheet.regions_across, sheet.regions_up);
  glm::dvec2 const middle = first + 0.5 * glm::dvec2(sheet.ray_offset) - half_region;
  run<interpolate>(
      Regions{sheet.whole_path.data(), static_cast<std::uint32_t>(sheet.regions_across),
              static_cast<std::uint32_t>(sheet.regions_up)},
      TilePositions(middle, step, tile), passed);
}

}  // namespace gpu_shading
