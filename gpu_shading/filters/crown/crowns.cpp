#include "filters/crown/crowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/ring.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr RayPart everywhere{-infinite, infinite};
constexpr RayPart nowhere{infinite, -infinite};

RayPart common(RayPart const& a, RayPart const& b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

RayPart between_ends(double position, double step) {
  if (step == 0.0) return std::abs(position) <= 1.0 ? everywhere : nowhere;
  double const a = (-1.0 - position) / step;
  double const b = (1.0 - position) / step;
  return {std::min(a, b), std::max(a, b)};
}

void check(std::string_view field, double value, double least, double most) {
  // Written so that NaN fails.
  if (value >= least && value <= most) return;
  throw Error(
      fmt::format("{} of a crown is {:.9g}, expected {:.9g} to {:.9g}", field, value, least, most));
}

}  // namespace

CrownSolid solid_of(CrownShape shape) {
  switch (shape) {
    case CrownShape::cone:  // x^2 + y^2 <= ((1 - z) / 2)^2
      return {-0.25, 0.5, -0.25};
    case CrownShape::cylinder:
      return {0.0, 0.0, -1.0};
    case CrownShape::half_ellipsoid:  // x^2 + y^2 + ((1 + z) / 2)^2 <= 1
      return {0.25, 0.5, -0.75};
    case CrownShape::mesh:
      return {0.0, 0.0, 0.0};
    case CrownShape::ellipsoid:
      break;
  }
  return {1.0, 0.0, -1.0};
}

RayPart CrownSolid::inside(glm::dvec3 const& p, glm::dvec3 const& d) const {
  RayPart const ends = between_ends(p.z, d.z);
  double const a = d.x * d.x + d.y * d.y + square * d.z * d.z;
  double const b = p.x * d.x + p.y * d.y + square * p.z * d.z + 0.5 * linear * d.z;
  double const c = p.x * p.x + p.y * p.y + (square * p.z + linear) * p.z + constant;
  double const discriminant = b * b - a * c;
  if (a > 0.0) {
    if (discriminant <= 0.0) return nowhere;
    double const root = std::sqrt(discriminant);
    double const far = b >= 0.0 ? -(b + root) : root - b;
    double const one = far / a;
    double const other = c / far;
    return common(ends, {std::min(one, other), std::max(one, other)});
  }
  // Steeper than the sides of a cone, or along a cylinder.
  if (a == 0.0) {
    if (b == 0.0) return c < 0.0 ? ends : nowhere;
    double const crossing = -0.5 * c / b;
    return common(ends, b > 0.0 ? RayPart{-infinite, crossing} : RayPart{crossing, infinite});
  }
  if (discriminant <= 0.0) return ends;
  double const root = std::sqrt(discriminant);
  double const far = b >= 0.0 ? -(b + root) : root - b;
  double const one = far / a;
  double const other = c / far;
  // The part below the apex; another cone stands on it.
  return common(ends, d.z > 0.0 ? RayPart{-infinite, std::min(one, other)}
                                : RayPart{std::max(one, other), infinite});
}

glm::dvec3 Crowns::Entry::in_cube(glm::dvec3 const& vector) const {
  auto const along = [&](glm::dvec3 const& side) {
    return glm::dot(side, vector) / glm::dot(side, side);
  };
  return {along(half[0]), along(half[1]), along(half[2])};
}

std::array<glm::dvec3, 8> Crowns::Entry::corners() const {
  std::array<glm::dvec3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    corners.at(i) = centre;
    for (unsigned axis = 0; axis < 3; ++axis) {
      corners.at(i) += (i >> axis & 1U) != 0 ? half.at(axis) : -half.at(axis);
    }
  }
  return corners;
}

std::vector<CrownMesh::Triangle> Crowns::Entry::faces() const {
  std::vector<CrownMesh::Triangle> faces = crown.mesh->triangles();
  for (CrownMesh::Triangle& face : faces) {
    for (glm::dvec3& p : face) p = centre + p.x * half[0] + p.y * half[1] + p.z * half[2];
  }
  return faces;
}

double Crowns::Entry::reach() const {
  double reach = 0.0;
  for (CrownMesh::Triangle const& face : faces()) {
    for (glm::dvec3 const& corner : face) reach = std::max(reach, glm::distance(corner, centre));
  }
  return reach;
}

double Crowns::Entry::extinction(glm::dvec3 const& towards_sun,
                                 std::span<double const> deployments) const {
  auto const place = static_cast<std::size_t>(crown.deployment);
  double const leaves =
      crown.deployment >= 0 && place < deployments.size() ? deployments[place] : 1.0;
  double const cosine = glm::dot(glm::normalize(half[2]), towards_sun);
  // Branches have no angle of their own.
  return leaf_projection(crown.leaf_angles, cosine) * crown.leaf_density * leaves +
         leaf_projection(LeafAngles::spherical, cosine) * crown.wood_density;
}

Crowns::Entry Crowns::entry_of(SurfaceId id, Polygon const& polygon, Crown const& crown) {
  constexpr double tallest = 1e4;    // m
  constexpr double densest = 1e3;    // m2/m3
  constexpr double thinnest = 1e-3;  // m
  check("height", crown.height, thinnest, tallest);
  check("leaf area density", crown.leaf_density, 0.0, densest);
  check("wood area density", crown.wood_density, 0.0, densest);
  Ring const ring = without_repeats(polygon.outline);
  constexpr double rounding = 1e-6;
  auto const is_rectangle = [&] {
    if (ring.size() != 4 || !polygon.holes.empty() || is_degenerate(ring, newell(ring)))
      return false;
    glm::dvec3 const a = ring[1] - ring[0];
    glm::dvec3 const b = ring[2] - ring[1];
    double const size = glm::length(a) + glm::length(b);
    return glm::distance(ring[3] - ring[0], b) <= rounding * size &&
           std::abs(glm::dot(a, b)) <= rounding * glm::length(a) * glm::length(b);
  };
  if (!is_rectangle()) throw Error("a crown needs a rectangle without holes for its plan");
  glm::dvec3 const normal = glm::normalize(newell(ring));
  Entry entry{crown,
              id,
              0.5 * (ring[0] + ring[2]) + 0.5 * crown.height * normal,
              {0.5 * (ring[1] - ring[0]), 0.5 * (ring[2] - ring[1]), 0.5 * crown.height * normal},
              solid_of(crown.shape)};
  if ((crown.shape == CrownShape::mesh) != (crown.mesh != nullptr)) {
    throw Error("a crown of the shape mesh needs a mesh, and others have none");
  }
  if (crown.mesh) {
    constexpr double largest = 40.0;  // m2/m2
    check("density times reach", (crown.leaf_density + crown.wood_density) * entry.reach(), 0.0,
          largest);
  }
  return entry;
}

Crowns::Crowns(Scene const& scene) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const* const crown = scene[id].filter.find<Crown>();
    if (crown == nullptr) continue;
    if (numbers_.empty()) numbers_.assign(scene.size(), none);
    numbers_[id] = static_cast<int>(entries_.size());
    try {
      entries_.push_back(entry_of(id, scene[id].polygon, *crown));
    } catch (Error const& error) {
      throw Error(fmt::format("surface '{}': {}", scene[id].name, error.what()));
    }
  }
}

}  // namespace gpu_shading
