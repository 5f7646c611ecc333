#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"
#include "support/layered_transmittance.h"
#include "support/millimetre.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

// Square images of square tiles, with whole holes in each.
struct Image {
  int side;
  std::vector<std::uint16_t> opacity;

  explicit Image(int texels)
      : side(texels),
        opacity(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels), 0) {}

  void set(int column, int row, std::uint16_t value) {
    opacity[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
            static_cast<std::size_t>(column)] = value;
  }

  void fill(OpacityTile const& tile, int from, int to) {
    int const size = tile.columns();
    for (int row = 0; row < side; ++row) {
      for (int column = from; column < to; ++column) {
        int const place = (row + size / 2) % tile.rows() * size + (column + size / 2) % size;
        set(column, row, tile.opacity()[static_cast<std::size_t>(place)]);
      }
    }
  }

  OpacityTile tile(double texel, std::optional<double> threshold = 0.5) const {
    return {side * texel, side * texel, side, side, opacity, threshold};
  }
};

double mean(std::vector<float> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// From 0 to below an end.
std::vector<double> steps(double end, double step) {
  std::vector<double> values;
  for (int i = 0; i * step < end; ++i) values.push_back(i * step);
  return values;
}

double exact(HolePattern const& holes, double shift, double phi) {
  return holes.transmittance(shift * std::cos(phi), shift * std::sin(phi));
}

HolePattern straight(Hole hole, double size) {
  return HolePattern(
      {.hole = hole, .arrangement = Arrangement::Straight, .size = size, .pitch = 8 * mm});
}

// Holes that grow from left to right, in bands four regions wide.
TEST(ScreenRegions, OfAGradientAreEachTheirClosedForm) {
  constexpr int side = 2048;
  constexpr int bands = 4;
  double const texel = 8 * mm / 64;
  std::vector<HolePattern> holes;
  Image image(side);
  for (int band = 0; band < bands; ++band) {
    holes.push_back(straight(Hole::Round, (3 + band) * mm));
    image.fill(OpacityTile(holes.back(), texel), band * side / bands, (band + 1) * side / bands);
  }
  OpacityTile const tile = image.tile(texel);
  EXPECT_LT(tile.web(), 2.3 * mm);  // 2 mm in a quarter of it
  double const thickness = 3 * mm;
  ScreenTransmittance const table(tile, thickness);
  ASSERT_EQ(table.regions_across(), 16);
  ASSERT_EQ(table.regions_up(), 16);
  EXPECT_NEAR(table.longest_chord(), 6 * mm, 0.2 * mm);

  double largest = 0.0;
  double largest_of_mean = 0.0;
  for (double const shift : steps(7 * mm, 0.37 * mm)) {
    for (double const phi : steps(pi, 0.17)) {
      std::vector<float> const values = table.at_shift(shift, phi);
      ASSERT_EQ(values.size(), std::size_t{256});
      double expected_mean = 0.0;
      for (std::size_t region = 0; region < values.size(); ++region) {
        double const expected = exact(holes[region % 16 / 4], shift, phi);
        expected_mean += expected / static_cast<double>(values.size());
        largest = std::max(largest, std::abs(static_cast<double>(values[region]) - expected));
      }
      largest_of_mean = std::max(largest_of_mean, std::abs(mean(values) - expected_mean));
      EXPECT_NEAR(table(std::atan(shift / thickness), phi), mean(values), 1e-5);
      // At centres of regions, and halfway from the last column to the first.
      constexpr std::size_t last = 240;  // the first place of the last row
      EXPECT_FLOAT_EQ(static_cast<float>(table.at_place(shift, phi, {5.5 / 16, 2.5 / 16})),
                      values[2 * 16 + 5]);
      EXPECT_NEAR(table.at_place(shift, phi, {0.0, 15.5 / 16}),
                  0.5F * (values[last] + values[last + 15]), 1e-6);
      EXPECT_NEAR(table.at_place(shift, phi, {1.0, 15.5 / 16}),
                  0.5F * (values[last] + values[last + 15]), 1e-6);
    }
  }
  RecordProperty("region", std::to_string(largest));
  RecordProperty("mean", std::to_string(largest_of_mean));
  EXPECT_LT(largest, 1e-2);
  EXPECT_LT(largest_of_mean, 2e-3);

  for (double const shift : {0.0, 1.5 * mm, 4.1 * mm}) {
    double const phi = 0.4 + shift / mm;
    int const layers = layers_for(shift, tile.web(), table.longest_chord());
    EXPECT_NEAR(mean(table.at_shift(shift, phi)), layered_transmittance(tile, layers, shift, phi),
                3e-3);
  }
}

TEST(ScreenRegions, OfARepeatedPatternAreAllTheClosedForm) {
  for (Hole const hole : {Hole::Round, Hole::Square, Hole::Hexagonal}) {
    HolePattern const holes = straight(hole, 5 * mm);
    double const texel = 8 * mm / 64;
    Image image(512);
    image.fill(OpacityTile(holes, texel), 0, 512);
    ScreenTransmittance const table(image.tile(texel), 2 * mm);
    ASSERT_EQ(table.regions_across() * table.regions_up(), 16);
    for (double const shift : steps(6 * mm, 0.51 * mm)) {
      for (double const phi : steps(pi, 0.41)) {
        for (float const value : table.at_shift(shift, phi)) {
          EXPECT_NEAR(value, exact(holes, shift, phi), 1e-2);
        }
        EXPECT_NEAR(mean(table.at_shift(shift, phi)), exact(holes, shift, phi), 2e-3);
      }
    }
  }
}

TEST(ScreenRegions, AreOneForPatternsAndSmallTiles) {
  ScreenTransmittance const closed(straight(Hole::Round, 5 * mm), 2 * mm);
  ASSERT_EQ(closed.at_shift(1 * mm, 0.3).size(), std::size_t{1});
  EXPECT_FLOAT_EQ(closed.at_shift(1 * mm, 0.3)[0], static_cast<float>(closed(std::atan(0.5), 0.3)));
  EXPECT_EQ(closed.at_shift(5 * mm, 0.3)[0], 0.0F);
  EXPECT_DOUBLE_EQ(closed.at_place(1 * mm, 0.3, {0.7, 0.1}), closed(std::atan(0.5), 0.3));
  EXPECT_EQ(closed.at_place(5 * mm, 0.3, {0.7, 0.1}), 0.0);

  auto const regions = [](int columns, int rows) {
    std::vector<std::uint16_t> opacity(
        static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 65535);
    ScreenTransmittance const table(OpacityTile(1.0, 1.0, columns, rows, opacity), 0.001);
    return std::pair(table.regions_across(), table.regions_up());
  };
  EXPECT_EQ(regions(256, 256), std::pair(1, 1));
  EXPECT_EQ(regions(257, 10), std::pair(2, 1));
  EXPECT_EQ(regions(400, 512), std::pair(3, 4));
  EXPECT_EQ(regions(8192, 64), std::pair(32, 1));
}

// Bars of opacity 0.6 on the left; 0.2 all over the right.
TEST(ScreenRegions, OfFractionalOpacityCountItOnce) {
  constexpr int side = 512;
  Image image(side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      double const bars = column % 32 < 16 ? 0.6 : 0.0;
      image.set(column, row, static_cast<std::uint16_t>(65535 * (column < side / 2 ? bars : 0.2)));
    }
  }
  OpacityTile const tile = image.tile(0.1 * mm, std::nullopt);
  ScreenTransmittance const table(tile, 2 * mm);
  EXPECT_EQ(table.longest_chord(), std::numeric_limits<double>::infinity());
  for (double const shift : {0.0, 0.7 * mm, 1.3 * mm, 3.0 * mm}) {
    for (double const phi : {0.0, 0.9, pi / 2, 2.2}) {
      std::vector<float> const values = table.at_shift(shift, phi);
      EXPECT_NEAR(mean(values), layered_transmittance(tile, 32, shift, phi), 3e-3)
          << shift << ", " << phi;
      // Each bar covers all rays that begin within the shift before it, and never more than 0.6.
      double const across = std::min(1.6 * mm, shift * std::abs(std::cos(phi)));
      EXPECT_NEAR(values[4], 1.0 - 0.6 * (0.5 + across / (3.2 * mm)), 1e-2) << shift << ", " << phi;
      // Rays to the left meet the last bar.
      if (phi <= pi / 2) {
        EXPECT_NEAR(values[6], 0.8, 1e-3);
      }
    }
  }
}

TEST(ScreenRegions, OfOpenAndSolidImagesAreAllAndNone) {
  for (int const side : {1, 300}) {
    std::vector<std::uint16_t> opacity(static_cast<std::size_t>(side * side), 0);
    OpacityTile const open(0.1, 0.1, side, side, opacity);
    ScreenTransmittance const all(open, 0.002);
    EXPECT_EQ(all.longest_chord(), std::numeric_limits<double>::infinity());
    for (float const value : all.at_shift(0.3, 1.0)) EXPECT_EQ(value, 1.0F);
    EXPECT_EQ(all(1.5, 2.0), 1.0);
    EXPECT_EQ(layers_for(0.3, open.web(), all.longest_chord()), 1);
    EXPECT_EQ(open.hole(), std::numeric_limits<double>::infinity());

    std::fill(opacity.begin(), opacity.end(), std::uint16_t{65535});
    OpacityTile const solid(0.1, 0.1, side, side, opacity);
    ScreenTransmittance const none(solid, 0.002);
    EXPECT_EQ(none.longest_chord(), 0.0);
    EXPECT_EQ(none.cut_off(), 0.0);
    for (float const value : none.at_shift(0.0, 1.0)) EXPECT_EQ(value, 0.0F);
    EXPECT_EQ(none(0.0, 2.0), 0.0);
    EXPECT_EQ(layers_for(0.0, solid.web(), none.longest_chord()), 0);
  }
}

// Three quarters open, along u.
TEST(ScreenRegions, OfSlatsHaveNoCutOff) {
  constexpr int side = 512;
  Image image(side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      image.set(column, row, row % 64 < 48 ? 0 : 65535);
    }
  }
  ScreenTransmittance const table(image.tile(40 * mm / 64), 30 * mm);
  EXPECT_EQ(table.longest_chord(), std::numeric_limits<double>::infinity());
  for (float const value : table.at_shift(1.5, 0.0)) EXPECT_NEAR(value, 0.75F, 0.01F);
  for (float const value : table.at_shift(15 * mm, pi / 2)) EXPECT_NEAR(value, 0.375F, 0.01F);
  for (float const value : table.at_shift(32 * mm, pi / 2)) EXPECT_EQ(value, 0.0F);
}

}  // namespace
}  // namespace gpu_shading
