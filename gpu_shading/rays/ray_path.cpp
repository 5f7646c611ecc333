#include "rays/ray_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

bool is_finite(glm::dvec3 const& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string text(glm::dvec3 const& v) {
  return fmt::format("{:.9g}, {:.9g}, {:.9g}", v.x, v.y, v.z);
}

// Of unit length. Those that are, within rounding, are left as they are.
glm::dvec3 unit(glm::dvec3 const& direction) {
  double const square = glm::dot(direction, direction);
  constexpr double rounding = 1e-14;
  if (std::abs(square - 1.0) < rounding) return direction;
  // The square of a very short or very long one is not a number to divide by.
  double const most =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!is_finite(direction) || most == 0.0) {
    throw Error(fmt::format("a ray's direction is ({}), expected finite numbers that are not all 0",
                            text(direction)));
  }
  return glm::normalize(direction / most);
}

}  // namespace

RayPath::RayPath(Ray const& ray)
    : origin(ray.origin), direction(unit(ray.direction)), length(ray.length) {
  if (!is_finite(origin)) {
    throw Error(fmt::format("a ray's origin is ({}), expected finite numbers", text(origin)));
  }
  if (std::isnan(length)) throw Error("a ray's length is not a number");
  glm::dvec3 const size = glm::abs(direction);
  int const longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::array<int, 3> const order{(longest + 1) % 3, (longest + 2) % 3, longest};
  for (std::size_t i = 0; i < order.size(); ++i) {
    axes[i] = static_cast<std::size_t>(order[i]);
    start[i] = origin[order[i]];
  }
  double const each = 1.0 / direction[longest];
  shear = {direction[order[0]] * each, direction[order[1]] * each};
}

}  // namespace gpu_shading
