#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "gpu_shading/crown.h"

// Closed meshes in the cube of a crown.
namespace gpu_shading {

// Between two corners.
inline std::vector<CrownMesh::Triangle> box_triangles(glm::dvec3 const& low,
                                                      glm::dvec3 const& high) {
  std::vector<CrownMesh::Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (bool const top : {false, true}) {
      auto const corner = [&](bool u, bool v) {
        glm::dvec3 p(0.0);
        p[axis] = (top ? high : low)[axis];
        p[(axis + 1) % 3] = (u ? high : low)[(axis + 1) % 3];
        p[(axis + 2) % 3] = (v ? high : low)[(axis + 2) % 3];
        return p;
      };
      // Turned at random, as files have them.
      triangles.push_back({corner(false, false), corner(true, false), corner(true, true)});
      triangles.push_back({corner(false, false), corner(true, true), corner(false, true)});
    }
  }
  return triangles;
}

// Inscribed in the ball, of rings of longitude and latitude.
inline std::shared_ptr<CrownMesh const> ball_mesh(int sides) {
  using std::numbers::pi;
  auto const at = [&](int around, int up) {
    double const a = 2.0 * pi * (around % sides) / sides;
    double const b = pi * up / (sides / 2.0);
    if (up == 0 || 2 * up == sides) return glm::dvec3(0.0, 0.0, up == 0 ? -1.0 : 1.0);
    return glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
  };
  std::vector<CrownMesh::Triangle> triangles;
  for (int up = 0; 2 * up < sides; ++up) {
    for (int around = 0; around < sides; ++around) {
      if (up > 0) triangles.push_back({at(around, up), at(around + 1, up), at(around, up + 1)});
      if (2 * (up + 1) < sides) {
        triangles.push_back({at(around + 1, up), at(around + 1, up + 1), at(around, up + 1)});
      }
    }
  }
  return std::make_shared<CrownMesh const>(std::move(triangles));
}

}  // namespace gpu_shading
