#include <array>
#include <cmath>
#include <numbers>

#include "filters/crown/crowns.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

// The radius at a height of the cube, -1 .. 1.
double radius_at(CrownSolid const& solid, double z) {
  return std::sqrt(std::max(0.0, -((solid.square * z + solid.linear) * z + solid.constant)));
}

std::vector<double> levels_of(CrownShape shape, int sides) {
  if (shape == CrownShape::cylinder || shape == CrownShape::cone) return {-1.0, 1.0};
  // Even steps of the angle from the base or, if that is flat, from the middle of the ellipsoid.
  int const count = sides / (shape == CrownShape::ellipsoid ? 2 : 4);
  std::vector<double> levels;
  for (int i = 0; i <= count; ++i) {
    double const part = static_cast<double>(i) / count;
    levels.push_back(shape == CrownShape::ellipsoid ? -std::cos(pi * part)
                                                    : 2.0 * std::sin(0.5 * pi * part) - 1.0);
  }
  return levels;
}

}  // namespace

std::vector<Polygon> crown_faces(Polygon const& plan, Crown const& crown, int sides) {
  Crowns::Entry const entry = Crowns::entry_of(0, plan, crown);
  std::vector<Polygon> faces;
  if (entry.crown.mesh) {
    for (CrownMesh::Triangle const& triangle : entry.faces()) {
      faces.push_back({Ring(triangle.begin(), triangle.end()), {}});
    }
    return faces;
  }
  auto const corner = [&](int side, double z) {
    double const angle = 2.0 * pi * side / sides;
    double const radius = radius_at(entry.solid, z);
    return entry.centre + radius * std::cos(angle) * entry.half[0] +
           radius * std::sin(angle) * entry.half[1] + z * entry.half[2];
  };
  auto const is_point = [&](double z) { return radius_at(entry.solid, z) < 1e-6; };
  std::vector<double> const levels = levels_of(crown.shape, sides);
  for (std::size_t level = 1; level < levels.size(); ++level) {
    double const low = levels[level - 1];
    double const high = levels[level];
    for (int side = 0; side < sides; ++side) {
      Ring ring{corner(side, low)};
      if (!is_point(low)) ring.push_back(corner(side + 1, low));
      ring.push_back(corner(side + 1, high));
      if (!is_point(high)) ring.push_back(corner(side, high));
      faces.push_back({std::move(ring), {}});
    }
  }
  auto const add_end = [&](double z, int direction) {
    if (is_point(z)) return;
    Ring ring;
    for (int side = 0; side < sides; ++side) ring.push_back(corner(direction * side, z));
    faces.push_back({std::move(ring), {}});
  };
  add_end(levels.front(), -1);
  add_end(levels.back(), 1);
  return faces;
}

}  // namespace gpu_shading
