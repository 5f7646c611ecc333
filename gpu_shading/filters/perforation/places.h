#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace gpu_shading {

// A part of a tile, in metres.
struct Extent {
  double u;
  double v;
  double width;
  double height;
};

// Points n = 0, 1, .. spread evenly over an area (R2, Roberts 2018), from a start that differs
// between regions.
class Places {
 public:
  Places(Extent const& extent, std::size_t region)
      : extent_(extent),
        start_u_(static_cast<double>(region) * std::numbers::phi),
        start_v_(static_cast<double>(region) * std::numbers::sqrt2) {}

  double u(std::size_t n) const {
    return extent_.u + extent_.width * part(start_u_ + static_cast<double>(n) * first);
  }
  double v(std::size_t n) const {
    return extent_.v + extent_.height * part(start_v_ + static_cast<double>(n) * second);
  }

 private:
  static constexpr double first = 0.7548776662466927;   // the plastic number's reciprocal
  static constexpr double second = 0.5698402909980532;  // and the square of that
  static double part(double value) { return value - std::floor(value); }

  Extent extent_;
  double start_u_;
  double start_v_;
};

}  // namespace gpu_shading
