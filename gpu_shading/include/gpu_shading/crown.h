#pragma once

#include <vector>

#include "gpu_shading/polygon.h"

namespace gpu_shading {

// The half ellipsoid is flat at its base.
enum class CrownShape { ellipsoid, cone, cylinder, half_ellipsoid };

// How steep the leaves are: spherical as the facets of a sphere, planophile mostly level,
// erectophile mostly upright (the last two after de Wit, 1965).
enum class LeafAngles { spherical, planophile, erectophile };

// The crown of a tree, whose leaves are at random places in a solid over the surface's polygon, a
// rectangle. The solid fills the box from the polygon along its normal: an ellipse inscribed in the
// rectangle is its plan. The beam passes with the probability of meeting no leaf,
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
};

// G: the area that leaves project onto a plane across the beam, over their one-sided area. `cosine`
// is that of the beam's angle to the crown's axis. Spherical 0.5; for other leaves, Ross's integral
// over their angles, within 1e-6.
double leaf_projection(LeafAngles angles, double cosine);

// The outside of a crown, for pictures: faces inscribed in it, with this many around it. Throws
// Error as a renderer does.
std::vector<Polygon> crown_faces(Polygon const& plan, Crown const& crown, int sides);

}  // namespace gpu_shading
