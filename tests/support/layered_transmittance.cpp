#include "support/layered_transmittance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace gpu_shading {
namespace {

// Positions of the rays in a texel, u and v, each in its own quarter both ways. An edge along rows
// or columns crosses all texels at the same position, which four rays resolve to a quarter of a
// texel; so rows are also displaced, each differently.
struct Offset {
  double u;
  double v;
};
constexpr std::array<Offset, 4> offsets{
    {{-0.375, -0.125}, {-0.125, 0.375}, {0.125, -0.375}, {0.375, 0.125}}};

// Multiples of the golden ratio, spread evenly over a texel.
double displacement(std::size_t row) {
  double const multiple = static_cast<double>(row) * std::numbers::phi;
  return multiple - std::floor(multiple) - 0.5;
}

// A row of rays, one per texel, and what passes the layers of the tile so far.
class RowOfRays {
 public:
  explicit RowOfRays(OpacityTile const& tile)
      : tile_(tile),
        columns_(static_cast<std::size_t>(tile.columns())),
        rows_(static_cast<std::size_t>(tile.rows())),
        opacity_(2 * columns_ + 1),
        solid_(columns_) {}

  void begin() { std::fill(solid_.begin(), solid_.end(), 0.0F); }

  // Applies a layer at a position in texels from the centre of the first texel.
  void pass(double u, double v) {
    interpolate_rows(v);
    Place const place = within(u, columns_);
    float const* const opacity = &opacity_[place.whole];
    if (tile_.threshold()) {
      auto const limit = static_cast<float>(*tile_.threshold());
      for (std::size_t k = 0; k < columns_; ++k) {
        float const value = opacity[k] + place.part * (opacity[k + 1] - opacity[k]);
        solid_[k] = std::max(solid_[k], value > limit ? 1.0F : 0.0F);
      }
    } else {
      for (std::size_t k = 0; k < columns_; ++k) {
        float const value = opacity[k] + place.part * (opacity[k + 1] - opacity[k]);
        solid_[k] = std::max(solid_[k], value);
      }
    }
  }

  double blocked() const { return std::accumulate(solid_.begin(), solid_.end(), 0.0); }

 private:
  struct Place {
    std::size_t whole = 0;
    float part = 0.0F;
  };

  static Place within(double texels, std::size_t count) {
    auto const period = static_cast<double>(count);
    double within = texels - std::floor(texels / period) * period;
    if (!(within < period)) within = 0.0;
    double const whole = std::floor(within);
    return {static_cast<std::size_t>(whole), static_cast<float>(within - whole)};
  }

  // The interpolated row between two rows of texels, stored twice plus one texel, so that shifts
  // need no remainder.
  void interpolate_rows(double v) {
    Place const place = within(v, rows_);
    std::uint16_t const* const lower = tile_.opacity().data() + place.whole * columns_;
    std::uint16_t const* const upper =
        tile_.opacity().data() + (place.whole + 1) % rows_ * columns_;
    for (std::size_t k = 0; k < columns_; ++k) {
      auto const below = static_cast<float>(lower[k]);
      auto const above = static_cast<float>(upper[k]);
      opacity_[k] = (below + place.part * (above - below)) / 65535.0F;
    }
    auto const end = opacity_.begin() + static_cast<std::ptrdiff_t>(columns_);
    std::copy(opacity_.begin(), end, end);
    opacity_.back() = opacity_.front();
  }

  OpacityTile const& tile_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<float> opacity_;
  std::vector<float> solid_;
};

}  // namespace

double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi) {
  if (layers <= 0) return 0.0;
  double const texels_u = shift * std::cos(phi) / tile.texel_width();
  double const texels_v = shift * std::sin(phi) / tile.texel_height();
  auto const rows = static_cast<std::size_t>(tile.rows());
  RowOfRays rays(tile);
  double blocked = 0.0;
  for (Offset const& offset : offsets) {
    for (std::size_t row = 0; row < rows; ++row) {
      rays.begin();
      for (int layer = 0; layer < layers; ++layer) {
        double const way = layers == 1 ? 0.0 : static_cast<double>(layer) / (layers - 1);
        rays.pass(texels_u * way + offset.u + displacement(row),
                  texels_v * way + offset.v + static_cast<double>(row));
      }
      blocked += rays.blocked();
    }
  }
  return 1.0 - blocked / (static_cast<double>(offsets.size()) * tile.columns() * tile.rows());
}

}  // namespace gpu_shading
