#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geometry/plane_frame.h"

namespace gpu_shading {

// Projection along the sun's rays onto a receiver's plane, from places as RelativePolygon has them.
class Projection {
 public:
  Projection(PlaneFrame const& frame, glm::dvec3 const& towards_sun)
      : slide_(glm::dvec2(glm::dot(frame.u, towards_sun) / frame.width,
                          glm::dot(frame.v, towards_sun) / frame.height) /
               glm::dot(frame.normal, towards_sun)) {}

  glm::dvec2 operator()(glm::dvec3 const& place) const {
    return glm::dvec2(place) - place.z * slide_;
  }
  // Whether a flat ring with this vector by Newell is projected clockwise.
  bool turns(glm::dvec3 const& normal) const {
    return normal.z + glm::dot(slide_, glm::dvec2(normal)) < 0.0;
  }

 private:
  glm::dvec2 slide_;
};

}  // namespace gpu_shading
