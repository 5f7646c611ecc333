// The effective transmittance of many rays through an image, against the table's, one by one in
// double precision.

#include "filters/perforation/region_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "filters/perforation/screens.h"
#include "gpu_shading/perforated_screen.h"
#include "support/millimetre.h"

namespace gpu_shading {
namespace {

// Holes of 8 x 8 texels, more of them to the right and to the top.
OpacityTile random_holes(int columns, int rows) {
  constexpr int hole = 8;
  std::mt19937 engine(3);
  std::vector<float> opacity(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; row += hole) {
    for (int column = 0; column < columns; column += hole) {
      double const share = 0.5 * (static_cast<double>(column) / columns + 1.0 * row / rows);
      float const value = static_cast<double>(engine() % 1000) < 1000.0 * share ? 0.0F : 1.0F;
      for (int y = row; y < row + hole; ++y) {
        for (int x = column; x < column + hole; ++x) {
          auto const before = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns);
          opacity[before + static_cast<std::size_t>(x)] = value;
        }
      }
    }
  }
  return OpacityTile(columns * mm, rows * mm, columns, rows, opacity);
}

TEST(RegionRays, AreAsTheTable) {
  auto const screen = std::make_shared<PerforatedScreen const>(
      random_holes(512, 768), Sheet{.thickness = 3 * mm, .detail = ScreenDetail::effective});
  ASSERT_NE(screen->transmittance().regions_across(), screen->transmittance().regions_up());
  Screens::Entry entry;
  entry.screen = screen;
  entry.normal = {0, 0, 1};
  entry.u = {1, 0, 0};
  entry.v = {0, 1, 0};
  glm::dvec2 const size(screen->tile()->width(), screen->tile()->height());
  for (glm::dvec3 const sun : {glm::dvec3(0, 0, 1), glm::dvec3(0.5, -0.3, 0.8)}) {
    SheetInBeam const sheet = sheet_in_beam(entry, glm::normalize(sun), 1.0, true);
    glm::dvec2 const shift = 3 * mm * glm::dvec2(sun) / sun.z;
    glm::dvec2 const step(-31.7 * mm, 7.9 * mm);
    for (glm::dvec2 const first : {glm::dvec2(0.0), glm::dvec2(-0.71, 3.3), size}) {
      PatternRays::Passed passed{};
      find_by_region(sheet, first, step, passed);
      for (std::size_t ray = 0; ray < passed.size(); ++ray) {
        glm::dvec2 const place = first + static_cast<double>(ray) * step + 0.5 * shift;
        EXPECT_NEAR(passed[ray],
                    screen->transmittance().at_place(
                        glm::length(shift), std::atan2(shift.y, shift.x), glm::fract(place / size)),
                    1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace gpu_shading
