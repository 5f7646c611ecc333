#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"
#include "view/view.h"

namespace gpu_shading {

// A part of a ray, in metres along it; empty if it ends before it begins.
struct RayPart {
  double begin;
  double end;

  double length() const { return end > begin ? end - begin : 0.0; }
};

// A solid within the cube from -1 to 1: between z = -1 and 1, where
// x^2 + y^2 + square z^2 + linear z + constant <= 0. crown.frag uses the same numbers.
struct CrownSolid {
  double square = 0.0;
  double linear = 0.0;
  double constant = 0.0;

  // Where a ray that may run both ways is inside, by its position at 0 and its change per metre.
  RayPart inside(glm::dvec3 const& position, glm::dvec3 const& step) const;
};
CrownSolid solid_of(CrownShape shape);  // empty of a mesh

// Where a line at a height y crosses a triangle whose corners are (x, y, distance). Two triangles
// have the same ends at an edge that they share, so that no ray passes between them or meets both.
struct FaceCrossing {
  double low;  // it covers x from here, up to less than `high`
  double high;
  double distance;     // at `low`
  double slope;        // of the distance
  bool anticlockwise;  // the triangle, with y left of x

  static std::optional<FaceCrossing> of(CrownMesh::Triangle const& corners, double y);
  double distance_at(double x) const { return distance + (x - low) * slope; }
};

// The scene's crowns, numbered from 0 in its order.
class Crowns {
 public:
  struct Entry {
    Crown crown;
    SurfaceId surface = 0;
    glm::dvec3 centre{0.0};  // of its box
    // Half the sides of the box; the last is along the crown's axis.
    std::array<glm::dvec3, 3> half;
    CrownSolid solid;

    // From the scene into the cube; of a vector.
    glm::dvec3 in_cube(glm::dvec3 const& vector) const;
    std::array<glm::dvec3, 8> corners() const;
    // Of its mesh, in the scene.
    std::vector<CrownMesh::Triangle> faces() const;
    // Of its farthest vertex from the centre, if it has a mesh.
    double reach() const;
    // Of the beam, per metre of path. `deployments`: shares of leaves, 1 beyond the end.
    double extinction(glm::dvec3 const& towards_sun, std::span<double const> deployments) const;
  };

  // Throw Error if the polygon of a crown is no rectangle, or one of its numbers out of range.
  static Entry entry_of(SurfaceId id, Polygon const& polygon, Crown const& crown);
  explicit Crowns(Scene const& scene);

  static constexpr int none = -1;
  int number(SurfaceId id) const { return entries_.empty() ? none : numbers_[id]; }
  std::vector<Entry> const& entries() const { return entries_; }
  Entry const& operator[](int number) const { return entries_[static_cast<std::size_t>(number)]; }

 private:
  std::vector<int> numbers_;  // empty without crowns
  std::vector<Entry> entries_;
};

// A crown at one sun direction.
struct CrownInBeam {
  Crowns::Entry const* crown = nullptr;
  glm::dvec3 towards_sun{0.0};
  double extinction = 0.0;
};

// Multiplies the luminance of a tile's sunlit pixels by the transmittance of crowns, on the CPU: of
// the part of each ray in front of the view's cut. `pixels`: as for shade_by_screens.
void shade_by_crowns(LuminanceTile& shaded, PixelMask const& lit, View const& pixels,
                     std::span<CrownInBeam const> crowns);

}  // namespace gpu_shading
