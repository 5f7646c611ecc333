#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"
#include "support/degree.h"
#include "support/layered_transmittance.h"
#include "support/millimetre.h"
#include "support/refusal.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

constexpr double infinite = std::numeric_limits<double>::infinity();

// Hole, pitch and thickness in millimetres: thin, middling and thick sheets.
struct Sheet {
  double size;
  double pitch;
  double thickness;
};
void PrintTo(Sheet const& sheet, std::ostream* out) {
  *out << sheet.size << " of " << sheet.pitch << ", " << sheet.thickness << " thick";
}

constexpr Sheet sheets[] = {{5, 8, 3}, {5, 8, 0.5}, {5, 8, 10}, {6.35, 8.5521, 6.35}, {2, 3, 1}};

struct Case {
  std::string name;
  Hole hole;
  Arrangement arrangement;
};
Case const cases[] = {
    {"round 60", Hole::Round, Arrangement::Staggered60},
    {"round 45", Hole::Round, Arrangement::Staggered45},
    {"square", Hole::Square, Arrangement::Straight},
    {"hexagonal", Hole::Hexagonal, Arrangement::Staggered60},
};

HolePattern pattern(Case const& which, Sheet const& sheet) {
  return HolePattern({.hole = which.hole,
                      .arrangement = which.arrangement,
                      .size = sheet.size * mm,
                      .pitch = sheet.pitch * mm});
}

struct Difference {
  double mean = 0.0;
  double largest = 0.0;
};

// From the closed form, over theta 0 .. 85 and a quarter turn of phi, which holds every symmetry,
// at angles that tables lack.
template <typename Model>
Difference difference(HolePattern const& holes, double thickness, double step, Model const& model) {
  Difference found;
  int count = 0;
  for (int i = 0; i * step <= 85.0; ++i) {
    double const theta = i * step;
    for (int j = 0; j <= 10; ++j) {
      double const phi = 8.7 * j;
      double const shift = thickness * std::tan(theta * degree);
      double const exact =
          holes.transmittance(shift * std::cos(phi * degree), shift * std::sin(phi * degree));
      double const error = std::abs(model(theta * degree, phi * degree) - exact);
      found.mean += error;
      found.largest = std::max(found.largest, error);
      ++count;
    }
  }
  found.mean /= count;
  return found;
}

void record(std::string const& what, Difference const& found) {
  testing::Test::RecordProperty(
      what, std::to_string(found.mean) + " mean, " + std::to_string(found.largest) + " most");
}

class Screens : public testing::TestWithParam<Sheet> {};

TEST_P(Screens, OfAutoLayersAreTheClosedForm) {
  for (Case const& which : cases) {
    HolePattern const holes = pattern(which, GetParam());
    OpacityTile const tile(holes, GetParam().size * mm / 64);
    double const web = tile.web();
    Difference const found =
        difference(holes, GetParam().thickness * mm, 2.5, [&](double theta, double phi) {
          double const shift = GetParam().thickness * mm * std::tan(theta);
          int const layers = layers_for(shift, web, holes.longest_chord());
          return layered_transmittance(tile, layers, shift, phi);
        });
    record(which.name, found);
    EXPECT_LT(found.mean, 1e-3) << which.name;
    EXPECT_LT(found.largest, 5e-3) << which.name;
  }
}

TEST_P(Screens, TabulatedFromARasterAreTheClosedForm) {
  for (Case const& which : cases) {
    HolePattern const holes = pattern(which, GetParam());
    ScreenTransmittance const table(OpacityTile(holes, GetParam().size * mm / 48),
                                    GetParam().thickness * mm);
    Difference const found = difference(holes, GetParam().thickness * mm, 0.5, table);
    record(which.name, found);
    EXPECT_LT(found.mean, 5e-4) << which.name;
    EXPECT_LT(found.largest, 2e-3) << which.name;
    EXPECT_NEAR(table.longest_chord() / holes.longest_chord(), 1.0, 0.03) << which.name;
  }
}

TEST_P(Screens, TabulatedFromAPatternAreTheClosedForm) {
  for (Case const& which : cases) {
    HolePattern const holes = pattern(which, GetParam());
    ScreenTransmittance const table(holes, GetParam().thickness * mm);
    Difference const found = difference(holes, GetParam().thickness * mm, 0.3, table);
    record(which.name, found);
    EXPECT_LT(found.mean, 1e-4) << which.name;
    EXPECT_LT(found.largest, 1e-3) << which.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sheets, Screens, testing::ValuesIn(sheets));

TEST(ScreenTransmittance, IsTheSameForABeamAndItsReverse) {
  HolePattern const holes({.hole = Hole::Slotted,
                           .arrangement = Arrangement::Staggered60,
                           .size = 4 * mm,
                           .length = 20 * mm,
                           .pitch = 25 * mm,
                           .row_pitch = 7 * mm});
  ScreenTransmittance const table(OpacityTile(holes, 0.1 * mm), 2 * mm);
  for (int i = 0; i < 63; ++i) {
    double const phi = 0.1 * i - pi;
    for (double const theta : {0.3, 0.9, 1.2}) {
      EXPECT_NEAR(table(theta, phi), table(theta, phi + pi), 1e-6);
      double const shift = 2 * mm * std::tan(theta);
      EXPECT_NEAR(table(theta, phi),
                  holes.transmittance(shift * std::cos(phi), shift * std::sin(phi)), 5e-3);
    }
  }
}

TEST(ScreenTransmittance, IsNoneFromTheCutOff) {
  HolePattern const holes({.size = 5 * mm, .pitch = 8 * mm});
  ScreenTransmittance const table(holes, 5 * mm);
  EXPECT_NEAR(table.cut_off(), 45.0 * degree, 1e-12);
  EXPECT_GT(table(44.5 * degree, 1.0), 0.0);
  EXPECT_EQ(table(45.1 * degree, 1.0), 0.0);
  EXPECT_EQ(table(90.0 * degree, 1.0), 0.0);
  EXPECT_EQ(table(91.0 * degree, 1.0), 0.0);
  EXPECT_EQ(layers_for(5 * mm, 3 * mm, 5 * mm), 0);
}

TEST(ScreenTransmittance, NeedsLayersBetweenAgainstRaysIntoTheNextHole) {
  HolePattern const holes({.size = 5 * mm, .pitch = 8 * mm});
  OpacityTile const tile(holes, 0.1 * mm);
  double const shift = holes.width();
  EXPECT_NEAR(layered_transmittance(tile, 2, shift, 0.0), holes.open_fraction(), 2e-3);
  EXPECT_EQ(layered_transmittance(tile, 1 + 3, shift, 0.0), 0.0);
  EXPECT_EQ(layered_transmittance(tile, 0, 0.0, 0.0), 0.0);
}

TEST(LayersFor, AreNoFartherApartThanAWeb) {
  EXPECT_EQ(layers_for(0.0, 3 * mm, 5 * mm), 1);
  EXPECT_EQ(layers_for(2.9 * mm, 3 * mm, 5 * mm), 2);
  EXPECT_EQ(layers_for(4.9 * mm, 3 * mm, 5 * mm), 3);
  EXPECT_EQ(layers_for(4.9 * mm, 0.01 * mm, 5 * mm), 64);
  EXPECT_EQ(layers_for(4.9 * mm, 0.01 * mm, 5 * mm, 20), 20);
}

TEST(ScreenTransmittance, OfNoThicknessIsTheOpenFraction) {
  HolePattern const holes({.size = 5 * mm, .pitch = 8 * mm});
  ScreenTransmittance const table(holes, 0.0);
  for (double const theta : {0.0, 45.0, 90.0}) {
    EXPECT_NEAR(table(theta * degree, 0.5), holes.open_fraction(), 1e-6);
  }
  EXPECT_EQ(refusal_of([&] { ScreenTransmittance(holes, -0.001); }),
            "thickness is -0.001 m, expected 0 or more");
}

// Rows 0 to 2 of four open.
TEST(ScreenTransmittance, OfSlatsHasNoCutOffAlongThem) {
  std::vector<float> opacity(std::size_t{64} * 64, 0.0F);
  std::fill(opacity.begin() + std::ptrdiff_t{48} * 64, opacity.end(), 1.0F);
  ScreenTransmittance const table(OpacityTile(0.04, 0.04, 64, 64, opacity), 0.03);
  EXPECT_EQ(table.longest_chord(), std::numeric_limits<double>::infinity());
  for (double const theta : {0.0, 45.0, 80.0, 89.0})
    EXPECT_NEAR(table(theta * degree, 0), 0.75, 0.01);
  EXPECT_NEAR(table(std::atan(0.5), pi / 2), 0.375, 0.01);
  EXPECT_EQ(table(60.0 * degree, pi / 2), 0.0);
}

TEST(ScreenTransmittance, OfFractionalOpacityCountsItOnce) {
  OpacityTile const mesh(0.01, 0.01, 8, 8, std::vector<float>(64, 0.3F), std::nullopt);
  EXPECT_NEAR(layered_transmittance(mesh, 10, 0.02, 0.7), 0.7, 1e-5);
  EXPECT_NEAR(ScreenTransmittance(mesh, 0.001)(1.0, 0.7), 0.7, 1e-5);
  OpacityTile const thresholded(0.01, 0.01, 8, 8, std::vector<float>(64, 0.3F));
  EXPECT_EQ(layered_transmittance(thresholded, 10, 0.02, 0.7), 1.0);
}

TEST(ScreenTransmittance, OfSolidAndOpenTexelsIsNoneAndAll) {
  EXPECT_EQ(ScreenTransmittance(OpacityTile(0.01, 0.01, 1, 1, std::vector{1.0F}), 0.001)(0.0, 0.0),
            0.0);
  EXPECT_EQ(ScreenTransmittance(OpacityTile(0.01, 0.01, 1, 1, std::vector{0.0F}), 0.001)(1.0, 0.5),
            1.0);
}

TEST(OpacityTile, FindsTheWebAndTheOpenFractionOfAPattern) {
  for (Sheet const& sheet : sheets) {
    for (Case const& which : cases) {
      HolePattern const holes = pattern(which, sheet);
      for (auto const threshold : {std::optional<double>(0.5), std::optional<double>()}) {
        OpacityTile const tile(holes, sheet.size * mm / 32, threshold);
        EXPECT_NEAR(tile.open_fraction(), holes.open_fraction(), threshold ? 8e-3 : 2e-3)
            << which.name;
        EXPECT_LT(tile.web(), holes.web() + tile.texel_height()) << which.name;
        EXPECT_GT(tile.web(), 0.85 * holes.web() - tile.texel_height()) << which.name;
      }
    }
  }
}

// Wires along v, of opacity `wire` in one of `columns` texels 3 mm wide: interpolated linearly to
// 0 on both sides, they are above a half over 2 - 1 / wire texels.
struct Wires {
  int columns;
  float wire;

  double pitch() const { return columns * 3 * mm; }
  double width() const { return (2.0 - 1.0 / static_cast<double>(wire)) * 3 * mm; }
  OpacityTile tile() const {
    std::vector<float> opacity(static_cast<std::size_t>(columns) * 64, 0.0F);
    for (std::size_t row = 0; row < 64; ++row)
      opacity[row * static_cast<std::size_t>(columns)] = wire;
    return {pitch(), 64 * 3 * mm, columns, 64, opacity};
  }
  double transmittance(double theta, double phi, double thickness) const {
    double const across = thickness * std::tan(theta) * std::abs(std::cos(phi));
    return std::max(0.0, 1.0 - (width() + across) / pitch());
  }
};

class OneTexelWide : public testing::TestWithParam<Wires> {};

TEST_P(OneTexelWide, WiresAreTheClosedFormInLayersAndInATable) {
  double const thickness = 10 * mm;
  OpacityTile const tile = GetParam().tile();
  EXPECT_LE(tile.web(), GetParam().width());
  ScreenTransmittance const table(tile, thickness);
  for (double const theta : {0.0, 20.0, 45.0, 60.0, 70.0, 80.0}) {
    for (double const phi : {0.0, 30.0, 66.0, 90.0, 123.0}) {
      double const expected = GetParam().transmittance(theta * degree, phi * degree, thickness);
      double const shift = thickness * std::tan(theta * degree);
      int const layers = layers_for(shift, tile.web(), table.longest_chord());
      // Rays are a 256th of a texel apart.
      EXPECT_NEAR(layered_transmittance(tile, layers, shift, phi * degree), expected,
                  1.0 / (32 * GetParam().columns))
          << theta << ", " << phi;
      EXPECT_NEAR(table(theta * degree, phi * degree), expected, 5e-3) << theta << ", " << phi;
      if (expected == 0.0) {
        EXPECT_EQ(layered_transmittance(tile, layers, shift, phi * degree), 0.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Wires, OneTexelWide,
                         testing::Values(Wires{8, 1.0F}, Wires{3, 1.0F}, Wires{8, 0.6F},
                                         Wires{40, 0.75F}));

// Where nothing is thresholded, what passes wires of four texels is the mean over all thresholds.
TEST(OpacityTile, OfFractionalOpacityHasLayersForItsWires) {
  constexpr int columns = 20;
  std::vector<float> opacity(std::size_t{columns} * 8, 0.0F);
  for (std::size_t at = 0; at < opacity.size(); ++at) opacity[at] = at % columns < 4 ? 1.0F : 0.0F;
  OpacityTile const tile(columns * mm, 8 * mm, columns, 8, opacity, std::nullopt);
  for (double const shift : {0.0, 2.5 * mm, 6.0 * mm, 10.9 * mm, 40.0 * mm}) {
    // Three texels and the slopes beside them, on average one.
    double const expected = std::max(0.0, 1.0 - (4.0 + shift / mm) / columns);
    int const layers = layers_for(shift, tile.web(), infinite);
    EXPECT_NEAR(layered_transmittance(tile, layers, shift, 0.0), expected, 1e-3) << shift;
  }
}

// Leaves of many directions, cut out of a sheet but for ribs one texel wide along their middles.
OpacityTile leaves(std::optional<double> threshold) {
  constexpr int side = 128;
  constexpr int points = 4;  // of a texel, each way
  struct Leaf {
    double u, v, angle, half_length;
  };
  constexpr int count = 16;
  std::vector<Leaf> all;
  all.reserve(count);
  for (int n = 0; n < count; ++n) {
    // Spread evenly (R2, Roberts 2018).
    all.push_back({std::fmod(0.7548776662 * n, 1.0) * side, std::fmod(0.5698402910 * n, 1.0) * side,
                   2.4 * n, 14.0 + n % 8 * 2.0});
  }
  auto const is_open = [&](double u, double v) {
    return std::ranges::any_of(all, [&](Leaf const& leaf) {
      double const du = std::remainder(u - leaf.u, side);
      double const dv = std::remainder(v - leaf.v, side);
      double const along =
          (du * std::cos(leaf.angle) + dv * std::sin(leaf.angle)) / leaf.half_length;
      double const aside = std::abs(dv * std::cos(leaf.angle) - du * std::sin(leaf.angle));
      return aside > 0.5 && aside < 0.4 * leaf.half_length * (1.0 - along * along);
    });
  };
  std::vector<float> opacity;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      int solid = 0;
      for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
          if (!is_open(column + (i + 0.5) / points, row + (j + 0.5) / points)) ++solid;
        }
      }
      opacity.push_back(static_cast<float>(solid) / (points * points));
    }
  }
  return {side * mm, side * mm, side, side, opacity, threshold};
}

TEST(OpacityTile, OfLeavesIsTheSameInLayersInATableAndInVeryManyLayers) {
  double const thickness = 6 * mm;
  for (auto const threshold : {std::optional<double>(0.5), std::optional<double>()}) {
    OpacityTile const tile = leaves(threshold);
    ScreenTransmittance const table(tile, thickness);
    double largest = 0.0;
    for (double const theta : {15.0, 40.0, 55.0, 70.0, 80.0}) {
      double const shift = thickness * std::tan(theta * degree);
      int const layers = layers_for(shift, tile.web(), infinite);
      for (double const phi : {0.0, 26.0, 49.0, 90.0, 131.0, 160.0}) {
        int const very_many = 1 + static_cast<int>(std::ceil(shift / (0.1 * mm)));
        double const expected = layered_transmittance(tile, very_many, shift, phi * degree);
        double const passed = layered_transmittance(tile, layers, shift, phi * degree);
        largest = std::max(largest, std::abs(passed - expected));
        EXPECT_NEAR(table(theta * degree, phi * degree), expected, 3e-3) << theta << ", " << phi;
      }
    }
    RecordProperty(threshold ? "threshold" : "fractional", std::to_string(largest));
    EXPECT_LT(largest, threshold ? 1.5e-3 : 4e-3);
  }
}

// Noise on every texel, and one in 10000 inverted.
TEST(OpacityTile, HasTheWebOfAPatternInANoisyImage) {
  HolePattern const holes({.arrangement = Arrangement::Straight, .size = 5 * mm, .pitch = 8 * mm});
  OpacityTile const clean(holes, 8 * mm / 64);
  constexpr int side = 512;
  std::mt19937 random(20260601);
  std::normal_distribution<double> noise(0.0, 0.05);
  std::vector<float> opacity;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      std::uint16_t const texel =
          clean.opacity()[static_cast<std::size_t>(row % 64 * 64 + column % 64)];
      double const noisy = std::clamp(texel / 65535.0 + noise(random), 0.0, 1.0);
      opacity.push_back(static_cast<float>(random() % 10000 == 0 ? 1.0 - noisy : noisy));
    }
  }
  OpacityTile const tile(8 * holes.width(), 8 * holes.width(), side, side, opacity);
  EXPECT_NEAR(tile.web(), clean.web(), tile.texel_width());
  for (double const shift : {0.0, 1.1 * mm, 2.7 * mm, 4.0 * mm}) {
    int const layers = layers_for(shift, tile.web(), holes.longest_chord());
    EXPECT_LE(layers, 3);
    EXPECT_NEAR(layered_transmittance(tile, layers, shift, 0.3),
                holes.transmittance(shift * std::cos(0.3), shift * std::sin(0.3)), 2e-3);
  }
}

TEST(OpacityTile, HasTheRunsThatGoAroundItsEdges) {
  // A wire three texels wide across the edges between columns.
  std::vector<float> opacity(std::size_t{40} * 8, 0.0F);
  for (std::size_t row = 0; row < 8; ++row) {
    for (std::size_t const column : {0U, 1U, 39U}) opacity[row * 40 + column] = 1.0F;
  }
  OpacityTile const wire(0.04, 0.008, 40, 8, opacity);
  EXPECT_NEAR(wire.web(), 0.98079 * 3 * mm, 1e-6);
  EXPECT_NEAR(wire.hole(), 37.0 * 16.0 / 8.0 * mm, 1e-12);
  EXPECT_NEAR(wire.open_fraction(), 37.0 / 40.0, 1e-12);
  // A tile of one row.
  opacity.resize(40);
  EXPECT_NEAR(OpacityTile(0.04, 0.001, 40, 1, opacity).web(), 0.98079 * 3 * mm, 1e-6);
}

TEST(OpacityTile, KeepsSixteenBits) {
  OpacityTile const tile(0.01, 0.01, 4, 1, std::vector{0.0F, 0.5F, 0.25F, 1.0F});
  std::vector<std::uint16_t> const expected{0, 32767, 16384, 65535};
  EXPECT_TRUE(std::ranges::equal(tile.opacity(), expected));
  EXPECT_DOUBLE_EQ(tile.open_fraction(), 0.75);
  OpacityTile const fractional(0.01, 0.01, 4, 1, expected, std::nullopt);
  EXPECT_NEAR(fractional.open_fraction(), 1.0 - 1.75 / 4, 1e-5);
  // Compared as a shader does it: 128 / 255 is above a half, 127 / 255 is not.
  std::vector<std::uint16_t> const bytes{128 * 257, 127 * 257};
  EXPECT_DOUBLE_EQ(OpacityTile(0.01, 0.01, 2, 1, bytes).open_fraction(), 0.5);
}

TEST(OpacityTile, NamesWhatIsWrong) {
  EXPECT_EQ(refusal_of([] { OpacityTile(0.0, 0.01, 1, 1, std::vector{0.0F}); }),
            "tile width is 0 m, expected 1e-06 to 100000");
  EXPECT_EQ(refusal_of([] { OpacityTile(0.01, -1.0, 1, 1, std::vector{0.0F}); }),
            "tile height is -1 m, expected 1e-06 to 100000");
  EXPECT_EQ(refusal_of([] { OpacityTile(0.01, 0.01, 2, 2, std::vector{0.0F}); }),
            "texture has 1 texels, expected 2 x 2");
  EXPECT_EQ(refusal_of([] { OpacityTile(0.01, 0.01, 20000, 300, std::vector<std::uint16_t>()); }),
            "texture is 20000 x 300 texels, expected at most 16384 per side");
  EXPECT_EQ(refusal_of([] { OpacityTile(0.01, 0.01, 1, 1, std::vector{1.5F}); }),
            "opacity is 1.5, expected 0 to 1");
  EXPECT_EQ(refusal_of([] { OpacityTile(0.01, 0.01, 1, 1, std::vector{0.0F}, 1.0); }),
            "opacity threshold is 1, expected 0 to below 1");
  HolePattern const holes({.size = 5 * mm, .pitch = 8 * mm});
  EXPECT_EQ(refusal_of([&] { OpacityTile(holes, 0.0); }), "texel is 0 m, expected more than 0");
  EXPECT_EQ(refusal_of([&] { OpacityTile(holes, 1e-9); }),
            "texel is 1e-09 m, too small for a tile of 0.008 x 0.0138564065 m");
}

}  // namespace
}  // namespace gpu_shading
