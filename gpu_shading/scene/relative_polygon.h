#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/plane_frame.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// What is on one side of a receiver's plane of another polygon, or the receiver itself, in the
// receiver's coordinates: x and y in sides of its bounding rectangle from its centre, z in metres
// in front of the plane. At any direction of the sun, only z slides.
class RelativePolygon {
 public:
  enum class Side {
    in_front,  // of a caster, what is in front of the plane
    within,    // all of the receiver itself
    behind,    // of an interior surface, what is further than `clearance` from the plane
  };

  RelativePolygon() = default;
  // Cut by Sutherland & Hodgman (1974): parts that are cut off one another stay joined by edges in
  // the plane, which enclose no area.
  RelativePolygon(SurfaceId id, Polygon const& polygon, PlaneFrame const& frame, Side side) {
    set(id, polygon, frame, side);
  }
  // The same, in the memory of before.
  void set(SurfaceId id, Polygon const& polygon, PlaneFrame const& frame, Side side);

  SurfaceId id() const { return id_; }
  // The outline and the holes; an empty one has nothing on this side.
  std::size_t rings() const { return ends_.size(); }
  std::span<glm::dvec3 const> ring(std::size_t number) const {
    std::size_t const first = number == 0 ? 0 : ends_[number - 1];
    return {points_.data() + first, ends_[number] - first};
  }
  // The outline is flat and convex, so that it is from wherever it is seen.
  bool is_convex() const { return is_convex_; }
  // The outline's vector by Newell, of twice its area.
  glm::dvec3 const& normal() const { return normal_; }

 private:
  void add(Ring const& ring, PlaneFrame const& frame, Side side);

  SurfaceId id_ = 0;
  bool is_convex_ = false;
  glm::dvec3 normal_{0.0};
  std::vector<glm::dvec3> points_;
  std::vector<std::uint32_t> ends_;
};

}  // namespace gpu_shading
