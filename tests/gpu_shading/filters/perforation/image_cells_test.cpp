// Cells of an image against the same rays one by one, bilinear in double precision.

#include "filters/perforation/image_cells.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {
namespace {

constexpr double texel = 1e-3;

OpacityTile spots(int columns, int rows, std::optional<double> threshold) {
  std::mt19937 engine(7);
  std::vector<float> opacity;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      bool const edge = engine() % 50 == 0;
      bool const open = std::hypot(column % 20 - 9.5, row % 25 - 11.0) < 8.0;
      opacity.push_back(edge ? 0.3F : open ? 0.0F : 1.0F);
    }
  }
  return OpacityTile(columns * texel, rows * texel, columns, rows, opacity, threshold);
}

double bilinear(OpacityTile const& image, glm::dvec2 const& place) {
  double const x = place.x / texel - 0.5;
  double const y = place.y / texel - 0.5;
  auto const value = [&](double column, double row) {
    auto const around = [](double at, int count) {
      return static_cast<std::size_t>(at - std::floor(at / count) * count);
    };
    return static_cast<double>(
        image.opacity()[around(row, image.rows()) * static_cast<std::size_t>(image.columns()) +
                        around(column, image.columns())]);
  };
  double const part = x - std::floor(x);
  double const low =
      std::lerp(value(std::floor(x), std::floor(y)), value(std::floor(x) + 1, std::floor(y)), part);
  double const high = std::lerp(value(std::floor(x), std::floor(y) + 1),
                                value(std::floor(x) + 1, std::floor(y) + 1), part);
  return std::lerp(low, high, y - std::floor(y)) / OpacityTile::solid_texel;
}

struct Counts {
  int known = 0;
  int all = 0;
};

// Rays that pass layers at these parts of a displacement.
Counts check(OpacityTile const& image, glm::dvec2 const& ray) {
  glm::dvec2 const tile(image.width(), image.height());
  std::vector<double> const depths{0.0, 0.4, 1.0};
  std::vector<glm::dvec2> layers;
  for (double const depth : depths) {
    glm::dvec2 const tiles = depth * ray / tile;
    layers.push_back((tiles - glm::dvec2(std::floor(tiles.x), std::floor(tiles.y))) *
                     glm::dvec2(image.columns(), image.rows()));
  }
  ImageCells const cells(ImageBounds(image), layers);
  Counts counts;
  glm::dvec2 const step(0.00137, -0.00021);
  for (int row = 0; row < 40; ++row) {
    glm::dvec2 const first(-0.3 + 0.0047 * row, 0.9 - 0.0113 * row);
    ImageCells::Known const known = cells.find(TilePositions(first + 0.5 * texel, step, tile));
    EXPECT_EQ(known.open & known.solid, 0U);
    counts.known += std::popcount(known.open | known.solid);
    for (int i = 0; i < static_cast<int>(ImageCells::most); ++i, ++counts.all) {
      double most = 0.0;
      for (double const depth : depths) {
        most = std::max(most, bilinear(image, first + static_cast<double>(i) * step + depth * ray));
      }
      double const limit = image.threshold().value_or(0.0);
      if ((known.open >> i & 1U) != 0) {
        EXPECT_LE(most, limit);
      }
      if ((known.solid >> i & 1U) == 0) continue;
      if (image.threshold()) {
        EXPECT_GT(most, limit);
      } else {
        EXPECT_NEAR(most, 1.0, 1e-9);
      }
    }
  }
  return counts;
}

// 512 x 300 texels have cells of half of a texel, and the others of a quarter.
TEST(ImageCells, KnowWhatRaysMeet) {
  for (auto const threshold : {std::optional<double>(0.5), std::optional<double>(0.2),
                               std::optional<double>(0.0), std::optional<double>()}) {
    for (OpacityTile const& image : {spots(100, 75, threshold), spots(64, 64, threshold),
                                     spots(1, 3, threshold), spots(512, 300, threshold)}) {
      for (glm::dvec2 const ray :
           {glm::dvec2(0.0), glm::dvec2(0.0043, -0.0021), glm::dvec2(-0.21, 0.33)}) {
        Counts const counts = check(image, ray);
        // Of most rays, more is known than not.
        if (image.columns() == 100 && threshold == 0.5) {
          EXPECT_GT(counts.known, 0.8 * counts.all);
        }
      }
    }
  }
}

// Cells take as long as one ray in 64 of them.
TEST(ImageCells, AreMadeForManyRays) {
  OpacityTile const image = spots(100, 75, 0.5);
  EXPECT_FALSE(ImageCells::worth(image, 1000));
  EXPECT_TRUE(ImageCells::worth(image, 4000));
}

}  // namespace
}  // namespace gpu_shading
