#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

void check_thickness(double thickness) {
  if (thickness >= 0.0 && std::isfinite(thickness)) return;
  throw Error(fmt::format("thickness is {:.9g} m, expected 0 or more", thickness));
}

// Where in a texel rays are, u and v: each on its own quarter both ways. An edge along rows or
// columns is met by all texels at one place, which four rays know to a quarter of a texel; so rows
// are displaced besides, each differently.
struct Offset {
  double u;
  double v;
};
constexpr std::array<Offset, 4> offsets{
    {{-0.375, -0.125}, {-0.125, 0.375}, {0.125, -0.375}, {0.375, 0.125}}};

// Rays through a tile, four for each texel, and what layers of it leave of them.
class Rays {
 public:
  explicit Rays(OpacityTile const& tile)
      : tile_(tile),
        columns_(static_cast<std::size_t>(tile.columns())),
        rows_(static_cast<std::size_t>(tile.rows())),
        stride_(2 * columns_),
        solid_(offsets.size() * columns_ * rows_, 0.0F) {
    // Each row twice, so that shifts within a tile need no remainder.
    texels_.reserve(stride_ * rows_);
    for (std::size_t row = 0; row < rows_; ++row) {
      auto const texels = tile.opacity().subspan(row * columns_, columns_);
      for (int copy = 0; copy < 2; ++copy) {
        for (std::uint16_t const texel : texels) {
          texels_.push_back(static_cast<float>(texel) / 65535.0F);
        }
      }
    }
  }

  void reset() { std::fill(solid_.begin(), solid_.end(), 0.0F); }

  // A layer at which rays have moved by a shift. Returns the mean of what is left.
  double pass(double shift, double phi) {
    double const texels_u = shift * std::cos(phi) / tile_.texel_width();
    double const texels_v = shift * std::sin(phi) / tile_.texel_height();
    double blocked = 0.0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      Place const v = place(texels_v + offsets[i].v, rows_);
      for (std::size_t row = 0; row < rows_; ++row) {
        Place const u = place(texels_u + offsets[i].u + displacement(row), columns_);
        float const* const lower = &texels_[(row + v.whole) % rows_ * stride_ + u.whole];
        float const* const upper = &texels_[(row + v.whole + 1) % rows_ * stride_ + u.whole];
        float* const solid = &solid_[(i * rows_ + row) * columns_];
        auto const opacity = [=](std::size_t k) {
          float const below = lower[k] + u.part * (lower[k + 1] - lower[k]);
          float const above = upper[k] + u.part * (upper[k + 1] - upper[k]);
          return below + v.part * (above - below);
        };
        if (tile_.threshold()) {
          auto const limit = static_cast<float>(*tile_.threshold());
          blocked +=
              pass_row(solid, [=](std::size_t k) { return opacity(k) > limit ? 1.0F : 0.0F; });
        } else {
          blocked += pass_row(solid, opacity);
        }
      }
    }
    return 1.0 - blocked / static_cast<double>(solid_.size());
  }

 private:
  struct Place {
    std::size_t whole = 0;
    float part = 0.0F;
  };

  static Place place(double texels, std::size_t count) {
    auto const period = static_cast<double>(count);
    double within = texels - std::floor(texels / period) * period;
    if (!(within < period)) within = 0.0;
    double const whole = std::floor(within);
    return {static_cast<std::size_t>(whole), static_cast<float>(within - whole)};
  }

  // Multiples of the golden ratio, evenly spread over a texel.
  static double displacement(std::size_t row) {
    double const multiple = static_cast<double>(row) * std::numbers::phi;
    return multiple - std::floor(multiple) - 0.5;
  }

  // In lanes, which compilers make vectors of.
  template <typename Opacity>
  double pass_row(float* solid, Opacity const& opacity) const {
    constexpr std::size_t lanes = 8;
    std::array<float, lanes> sums{};
    std::size_t k = 0;
    for (; k + lanes <= columns_; k += lanes) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        solid[k + lane] = std::max(solid[k + lane], opacity(k + lane));
        sums[lane] += solid[k + lane];
      }
    }
    for (; k < columns_; ++k) {
      solid[k] = std::max(solid[k], opacity(k));
      sums[0] += solid[k];
    }
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  OpacityTile const& tile_;
  std::size_t columns_;
  std::size_t rows_;
  std::size_t stride_;
  std::vector<float> texels_;
  std::vector<float> solid_;
};

}  // namespace

int layers_for(double shift, double web, double longest_chord, int most) {
  if (shift >= longest_chord) return 0;
  return static_cast<int>(std::min(1.0 + std::ceil(shift / web), static_cast<double>(most)));
}

double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi) {
  if (layers <= 0) return 0.0;
  Rays rays(tile);
  double left = rays.pass(0.0, phi);
  for (int layer = 1; layer < layers; ++layer) left = rays.pass(shift * layer / (layers - 1), phi);
  return left;
}

ScreenTransmittance::ScreenTransmittance(HolePattern const& pattern, double thickness)
    : thickness_(thickness), longest_chord_(pattern.longest_chord()) {
  check_thickness(thickness);
  steps_ = 513;
  step_ = longest_chord_ / (steps_ - 1);
  for (int direction = 0; direction < directions(); ++direction) {
    double const phi = direction * pi / directions();
    for (int i = 0; i < steps_; ++i) {
      values_.push_back(static_cast<float>(
          pattern.transmittance(i * step_ * std::cos(phi), i * step_ * std::sin(phi))));
    }
  }
}

ScreenTransmittance::ScreenTransmittance(OpacityTile const& tile, double thickness)
    : thickness_(thickness) {
  check_thickness(thickness);
  step_ = std::max(std::min(tile.texel_width(), tile.texel_height()),
                   std::min(tile.web() / 2.0, std::min(tile.width(), tile.height()) / 128.0));
  double const farthest = 8.0 * (tile.width() + tile.height());
  Rays rays(tile);
  std::vector<std::vector<double>> left(directions());
  std::size_t longest = 2;
  bool ends = true;
  for (int direction = 0; direction < directions(); ++direction) {
    std::vector<double>& values = left[static_cast<std::size_t>(direction)];
    double const phi = direction * pi / directions();
    rays.reset();
    double shift = 0.0;
    do {
      values.push_back(rays.pass(shift, phi));
      shift = static_cast<double>(values.size()) * step_;
    } while (values.back() > 0.0 && shift <= farthest);
    ends = ends && values.back() <= 0.0;
    longest = std::max(longest, values.size());
  }
  steps_ = static_cast<int>(longest);
  longest_chord_ = ends ? (steps_ - 1) * step_ : std::numeric_limits<double>::infinity();
  for (std::vector<double>& values : left) {
    values.resize(longest, values.back());
    for (double const value : values) values_.push_back(static_cast<float>(value));
  }
}

double ScreenTransmittance::at(int direction, double shift) const {
  double const place = std::min(shift / step_, static_cast<double>(steps_ - 1));
  int const below = std::min(static_cast<int>(place), steps_ - 2);
  auto const index =
      static_cast<std::size_t>(direction % directions()) * static_cast<std::size_t>(steps_) +
      static_cast<std::size_t>(below);
  return std::lerp(static_cast<double>(values_[index]), static_cast<double>(values_[index + 1]),
                   place - below);
}

double ScreenTransmittance::operator()(double theta, double phi) const {
  if (thickness_ == 0.0) return open_fraction();
  // The tangent of pi/2 in doubles is finite and large.
  double const shift = thickness_ * std::tan(std::clamp(theta, 0.0, pi / 2.0));
  if (shift >= longest_chord_) return 0.0;
  double const turns = phi / pi;
  double const place = (turns - std::floor(turns)) * directions();
  int const below = static_cast<int>(place);
  return std::lerp(at(below, shift), at(below + 1, shift), place - below);
}

double ScreenTransmittance::cut_off() const { return std::atan2(longest_chord_, thickness_); }

}  // namespace gpu_shading
