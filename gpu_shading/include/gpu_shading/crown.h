#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gpu_shading/polygon.h"

namespace gpu_shading {

// The half ellipsoid is flat at its base.
enum class CrownShape { ellipsoid, cone, cylinder, half_ellipsoid, mesh };

// The outline of crowns of any shape, in the cube from -1 to 1 that a crown's box becomes: x and y
// along the first two sides of its plan, z along its axis. A path counts twice where two of its
// closed parts overlap.
class CrownMesh {
 public:
  using Triangle = std::array<glm::dvec3, 3>;

  // They may be turned either way. Throws Error if one reaches out of the cube, or unless each edge
  // belongs to two of them, with the same coordinates at its ends.
  explicit CrownMesh(std::vector<Triangle> triangles);

  // Counterclockwise as seen from outside.
  std::vector<Triangle> const& triangles() const { return triangles_; }
  double volume() const;  // in the cube, whose own is 8

 private:
  std::vector<Triangle> triangles_;
};

// How steep the leaves are: spherical as the facets of a sphere, planophile mostly level,
// erectophile mostly upright (the last two after de Wit, 1965).
enum class LeafAngles { spherical, planophile, erectophile };

// The crown of a tree, whose leaves are at random places in a solid over the surface's polygon, a
// rectangle. The solid fills the box from the polygon along its normal: an ellipse inscribed in the
// rectangle, or a mesh's own, is its plan. The beam passes with the probability of meeting no leaf,
// exp(-G x leaf area density x length of the path in the solid) (Ross, The radiation regime and
// architecture of plant stands, 1981), and so does what is left by wood.
struct Crown {
  static constexpr bool is_flat = false;
  CrownShape shape = CrownShape::ellipsoid;
  double height = 1.0;        // along the polygon's normal, m
  double leaf_density = 1.0;  // one-sided leaf area over the solid's volume, m2/m3
  LeafAngles leaf_angles = LeafAngles::spherical;
  double wood_density = 0.0;  // half of the area of branches over the volume, m2/m3; all year
  // Index of the share of leaves (Renderer::set_deployments); -1: always all.
  int deployment = -1;
  // Of the shape mesh. The sum of the densities times the distance of its farthest vertex from the
  // middle of its box may be up to 40 m2/m2, which single precision can multiply.
  std::shared_ptr<CrownMesh const> mesh = nullptr;
};

// G: the area that leaves project onto a plane across the beam, over their one-sided area. `cosine`
// is that of the beam's angle to the crown's axis. Spherical 0.5; for other leaves, Ross's integral
// over their angles, within 1e-6.
double leaf_projection(LeafAngles angles, double cosine);

// The outside of a crown, for pictures: those of its mesh, or faces inscribed in it, with this many
// around it. Throws Error as a renderer does.
std::vector<Polygon> crown_faces(Polygon const& plan, Crown const& crown, int sides);

}  // namespace gpu_shading
