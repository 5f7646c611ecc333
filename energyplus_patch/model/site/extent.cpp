#include "model/site/extent.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>

namespace gpu_shading::energyplus {

void Extent::include(Ring const& ring) {
  for (auto const& point : ring) {
    low_ = empty_ ? point : glm::min(low_, point);
    high_ = empty_ ? point : glm::max(high_, point);
    empty_ = false;
  }
}

double Extent::distance() const {
  auto const nearest = glm::clamp(glm::dvec3(0.0), low_, high_);
  return std::hypot(nearest.x, nearest.y);
}

std::string Extent::describe() const {
  if (empty_) return "no part of it is left";
  // No -0.
  auto const rounded = [](double value) { return std::round(10.0 * value) / 10.0 + 0.0; };
  return fmt::format("x {:.1f} to {:.1f}, y {:.1f} to {:.1f}, z {:.1f} to {:.1f} m",
                     rounded(low_.x), rounded(high_.x), rounded(low_.y), rounded(high_.y),
                     rounded(low_.z), rounded(high_.z));
}

}  // namespace gpu_shading::energyplus
