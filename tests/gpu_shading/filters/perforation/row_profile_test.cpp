// The effective transmittance of rows and columns of holes, against many single rays.

#include "filters/perforation/row_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "filters/perforation/pattern_rays.h"
#include "filters/perforation/sheet_rays.h"
#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/perforated_screen.h"
#include "support/millimetre.h"

namespace gpu_shading {
namespace {

std::vector<Perforation> perforations() {
  std::vector<Perforation> found;
  for (Hole const hole : {Hole::Round, Hole::Square, Hole::Slotted, Hole::Hexagonal}) {
    for (Arrangement const arrangement :
         {Arrangement::Straight, Arrangement::Staggered45, Arrangement::Staggered60}) {
      Perforation one{.hole = hole, .arrangement = arrangement, .size = 4 * mm, .pitch = 10 * mm};
      if (hole == Hole::Slotted) one.length = 7 * mm;
      found.push_back(one);
    }
  }
  return found;
}

// As far as profiles need it.
SheetInBeam sheet_of(Perforation const& holes, glm::dvec2 const& way) {
  HolePattern const pattern(holes);
  SheetInBeam sheet;
  sheet.tile = {pattern.width(), pattern.height()};
  sheet.ray_offset = way;
  sheet.half_hole = static_cast<float>(holes.size / 2.0);
  sheet.half_slot = static_cast<float>(std::max(0.0, holes.length - holes.size) / 2.0);
  sheet.staggered = holes.arrangement != Arrangement::Straight;
  sheet.shape = holes.hole == Hole::Square      ? SheetShape::square_holes
                : holes.hole == Hole::Hexagonal ? SheetShape::hexagonal_holes
                                                : SheetShape::round_holes;
  sheet.layers = exact_sheet;
  sheet.effective = glm::vec4(static_cast<float>(pattern.transmittance(way.x, way.y)));
  return sheet;
}

// The mean of value_at(place) along a line over a tile, at the middles of so many parts.
template <typename ValueAt>
double mean_along(glm::dvec2 const& from, glm::dvec2 const& along, int parts, ValueAt value_at) {
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) {
    sum += static_cast<double>(value_at(from + (i + 0.5) / parts * along));
  }
  return sum / parts;
}

TEST(RowProfile, IsTheMeanOfRaysAlongEachRowAndColumn) {
  constexpr int rays = 20000;
  constexpr int steps = 256;  // of a profile, which round its mean
  constexpr double within = 3e-3;
  for (Perforation const& holes : perforations()) {
    for (glm::dvec2 const way : {glm::dvec2(0.0), glm::dvec2(1.1 * mm, -0.7 * mm)}) {
      SheetInBeam const sheet = sheet_of(holes, way);
      RowProfile const profile(sheet);
      PatternRays const pattern(sheet);
      auto const by_rows = [&](glm::dvec2 const& place) { return profile.at(place); };
      auto const by_rays = [&](glm::dvec2 const& place) {
        return pattern.passes(place, way) ? 1.0 : 0.0;
      };
      glm::dvec2 const tile(sheet.tile);
      for (int i = 5; i < steps; i += 25) {
        double const share = (i + 0.5) / steps;
        glm::dvec2 const row(0.0, share * tile.y);
        glm::dvec2 const column(share * tile.x, 0.0);
        EXPECT_NEAR(mean_along(row, {tile.x, 0.0}, steps, by_rows),
                    mean_along(row, {tile.x, 0.0}, rays, by_rays), within);
        EXPECT_NEAR(mean_along(column, {0.0, tile.y}, steps, by_rows),
                    mean_along(column, {0.0, tile.y}, rays, by_rays), within);
      }
    }
  }
}

TEST(RowProfile, IsTheSameForManyRaysAtOnce) {
  Perforation const holes{.size = 4 * mm, .pitch = 10 * mm};
  SheetInBeam const sheet = sheet_of(holes, {1.1 * mm, -0.7 * mm});
  RowProfile const profile(sheet);
  glm::dvec2 const first(-3.21, 7.65);
  glm::dvec2 const step(-33.3 * mm, 4.1 * mm);
  RowProfile::Passed passed{};
  profile.find(first, step, passed);
  for (std::size_t i = 0; i < passed.size(); ++i) {
    EXPECT_EQ(passed[i], profile.at(first + static_cast<double>(i) * step)) << i;
  }
}

// Pixels larger than holes, and between.
TEST(RowProfile, TakesThePlaceOfTheEffectiveTransmittance) {
  Perforation const holes{
      .hole = Hole::Square, .arrangement = Arrangement::Straight, .size = 4 * mm, .pitch = 10 * mm};
  PerforatedScreen const screen(HolePattern(holes), Sheet{});
  SheetInBeam sheet = sheet_of(holes, glm::dvec2(0.0));
  sheet.blend_from = 0.001F;
  sheet.blend_to = 0.002F;
  RowProfile const profile(sheet);
  EXPECT_EQ(*SheetRays(screen, sheet, 3 * mm, false).everywhere(), sheet.effective[3]);
  SheetInBeam asked_for = sheet;
  asked_for.blend_from = -2.0F;
  asked_for.blend_to = -1.0F;
  EXPECT_EQ(*SheetRays(screen, asked_for, 3 * mm, true).everywhere(), sheet.effective[3]);
  for (double const pixel : {1.5 * mm, 3 * mm}) {
    float const weight = pixel > 2 * mm ? 1.0F : 0.5F;
    SheetRays const rays(screen, sheet, pixel, true);
    EXPECT_FALSE(rays.everywhere().has_value());
    SheetRays::Passed passed{};
    rays.whole_paths({0.0, 3 * mm}, {10 * mm, 0.0}, ~std::uint64_t{0}, passed);
    // Beside holes, in line with them one way.
    float const beside = weight * profile.at({0.0, 3 * mm});
    EXPECT_NEAR(passed[0], beside, 1e-6F);
    EXPECT_NEAR(rays.part_of_path({0.0, 3 * mm}, 0.0, 1.0), beside, 1e-6F);
    EXPECT_NEAR(beside, weight * 0.24F, 2e-3F);  // 0.4 of the column, less the mean of 0.16
  }
}

}  // namespace
}  // namespace gpu_shading
