#include "tasks/samples/sky_patches.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// Of `count` patches, of which the azimuths of the centres begin with `first` and increase by
// `step`.
struct SkyRow {
  double low;  // altitudes
  double high;
  int count;
  double first;
  double step;
};

void add_row(SkyRow const& row, std::vector<SkyPatch>& patches) {
  double const ring = 2.0 * pi * (std::sin(row.high) - std::sin(row.low));
  for (int i = 0; i < row.count; ++i) {
    double const azimuth = std::fmod(row.first + i * row.step + 2.0 * pi, 2.0 * pi);
    patches.push_back({{azimuth, (row.low + row.high) / 2.0}, ring / row.count});
  }
}

}  // namespace

SkyDivision energyplus_sky() {
  constexpr double height = pi / 2.0 / sky_rows;
  SkyDivision sky{"EnergyPlus 144", {}};
  for (int row = 0; row < sky_rows; ++row) {
    add_row({row * height, (row + 1) * height, sky_columns, pi / 2.0, -2.0 * pi / sky_columns},
            sky.patches);
  }
  return sky;
}

SkyDivision reinhart_sky(int factor) {
  constexpr std::array tregenza{30, 30, 24, 24, 18, 12, 6};
  double const height = pi / 2.0 / (static_cast<double>(tregenza.size()) * factor + 0.5);
  SkyDivision sky{"", {}};
  int row = 0;
  for (int const patches_in_row : tregenza) {
    for (int part = 0; part < factor; ++part, ++row) {
      int const count = factor * patches_in_row;
      add_row({row * height, (row + 1) * height, count, 0.0, 2.0 * pi / count}, sky.patches);
    }
  }
  sky.patches.push_back({{0.0, pi / 2.0}, 2.0 * pi * (1.0 - std::sin(row * height))});
  sky.name = fmt::format("{} {}", factor == 1 ? "Tregenza" : "Reinhart", sky.patches.size());
  return sky;
}

}  // namespace gpu_shading::energyplus
