#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>

#include "perforated_tables.h"

namespace gpu_shading {
namespace {

constexpr std::array details{ScreenDetail::holes, ScreenDetail::effective, ScreenDetail::automatic};

struct Row {
  double pixel_over_hole = 0.0;
  std::array<Errors, details.size()> errors;
};

// Size of a pixel of a square receiver's tile, whose pixel grid is rotated by an angle of golden
// slope.
double pixel_size(int resolution) {
  double const angle = std::atan(1.0 / std::numbers::phi);
  return (std::cos(angle) + std::sin(angle)) / (resolution - 2);
}

Row measure(PerforatedCase const& given, int resolution, std::span<SunDirection const> suns,
            std::span<double const> exact) {
  Row row;
  row.pixel_over_hole = pixel_size(resolution) / given.hole;
  for (std::size_t i = 0; i < details.size(); ++i) {
    Renderer renderer = renderer_of(
        given.scene(std::make_shared<PerforatedScreen const>(
            given.pattern(), Sheet{given.thickness, given.plane, std::nullopt, details[i]})),
        resolution);
    row.errors[i] = errors_of(renderer, suns, exact);
  }
  return row;
}

void print_ranges(std::span<Row const> rows) {
  std::printf("\n   px/hole  cases     holes effective automatic     holes effective automatic\n");
  constexpr std::array bounds{0.0, 0.25, 0.5, 1.0, 2.0, 4.0, std::numeric_limits<double>::max()};
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    int cases = 0;
    std::array<double, details.size()> mean{};
    std::array<double, details.size()> largest{};
    for (Row const& row : rows) {
      if (row.pixel_over_hole < bounds[i] || row.pixel_over_hole >= bounds[i + 1]) continue;
      ++cases;
      for (std::size_t k = 0; k < details.size(); ++k) {
        mean[k] += row.errors[k].mean();
        largest[k] = std::max(largest[k], row.errors[k].largest());
      }
    }
    if (cases == 0) continue;
    std::printf("from %5.2f %6d %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e\n", bounds[i], cases,
                mean[0] / cases, mean[1] / cases, mean[2] / cases, largest[0], largest[1],
                largest[2]);
  }
}

}  // namespace

void print_blend_table(std::span<SunDirection const> suns) {
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf(
      "                               mean abs                          largest\n"
      "hole mm  across pixels  px/hole     holes effective automatic     holes effective "
      "automatic\n");
  std::vector<Row> rows;
  for (double const hole :
       {1.0, 2.0, 3.0, 4.0, 5.0, 6.35, 8.0, 10.0, 12.7, 20.0, 30.0, 50.0, 100.0}) {
    PerforatedCase given;
    given.hole = given.thickness = 1e-3 * hole;
    std::vector<double> const exact = exact_fractions(given, suns);
    for (int const resolution : {64, 128, 256, 512, 1024}) {
      Row const row = measure(given, resolution, suns, exact);
      std::printf("%7.2f %7.1f %6d %8.3f %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e\n", hole,
                  1.0 / given.pitch(), resolution, row.pixel_over_hole, row.errors[0].mean(),
                  row.errors[1].mean(), row.errors[2].mean(), row.errors[0].largest(),
                  row.errors[1].largest(), row.errors[2].largest());
      std::fflush(stdout);
      rows.push_back(row);
    }
  }
  print_ranges(rows);
}

}  // namespace gpu_shading
