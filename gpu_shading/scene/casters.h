#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "scene/box_tree.h"
#include "scene/detail.h"
#include "scene/plane_frame.h"
#include "scene/screens.h"

namespace gpu_shading {

// A surface none of whose vertices stands this far in front of a receiver's plane, in metres, lies
// in that plane or behind it, and does not shade: neighbours meant to be coplanar differ by the
// rounding of a model's coordinates.
inline constexpr double coplanar = 1e-4;

// Casters are cut this far in front of the plane, in metres: the noise of float32 within a
// building. What it lets through is a strip of clearance x tan(incidence).
inline constexpr double clearance = 1e-6;

// A surface is in the sun from this cosine of incidence on, as in EnergyPlus (its SunIsUpValue).
inline constexpr double in_the_sun = 1e-3;

// Below this cosine of incidence a receiver is edge-on and gets nothing.
inline constexpr double edge_on = 1e-6;

// What may shade a receiver at one direction of the sun.
struct InView {
  std::vector<SurfaceId> casters;  // in the order of their ids
  Detail detail;                   // of their shadows
};

// The scene's surfaces as casters, for culling in double precision, at a cost that follows those in
// view. Conservative: a caster whose shadow touches the receiver is never lost.
class Casters {
 public:
  explicit Casters(Scene const& scene);

  // Those that may shade the receiver: some part clearly in front of its plane, that part, slid
  // along the sun's rays onto the plane, overlapping its bounding rectangle, and the rule allowing
  // it. `towards_sun` must be in front of the plane. Detail beyond `enough` is not looked at.
  InView in_view(Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
                 glm::dvec3 const& towards_sun, double enough) const;

 private:
  struct Caster {
    std::size_t first = 0;       // of points_
    std::size_t count = 0;       // of the outline; 0 for a degenerate surface
    std::size_t first_hole = 0;  // of holes_
    std::size_t holes = 0;
    glm::dvec3 normal{0.0};
    SheetFaces faces;  // of a screen
    bool planar = true;
    bool only_turned_away = false;
  };
  class Shadow;

  std::span<glm::dvec3 const> points(Caster const& caster) const {
    return {points_.data() + caster.first, caster.count};
  }
  std::span<Ring const> holes(Caster const& caster) const {
    return {holes_.data() + caster.first_hole, caster.holes};
  }

  bool is_in_view(Caster const& caster, PlaneFrame const& frame, Shadow& shadow) const;

  std::vector<Caster> casters_;
  std::vector<glm::dvec3> points_;
  std::vector<Ring> holes_;
  BoxTree tree_;
};

}  // namespace gpu_shading
