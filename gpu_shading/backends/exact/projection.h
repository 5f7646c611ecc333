#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "geometry/plane_frame.h"
#include "geometry/ring.h"
#include "scene/casters.h"

namespace gpu_shading {

// Projection along the sun's rays onto a receiver's plane, in sides of its bounding rectangle from
// its centre.
class Projection {
 public:
  Projection(PlaneFrame const& frame, glm::dvec3 const& towards_sun)
      : origin_(frame.origin), normal_(frame.normal) {
    double const cosine = glm::dot(frame.normal, towards_sun);
    x_ = (frame.u - frame.normal * (glm::dot(frame.u, towards_sun) / cosine)) / frame.width;
    y_ = (frame.v - frame.normal * (glm::dot(frame.v, towards_sun) / cosine)) / frame.height;
  }

  double height(glm::dvec3 const& point) const { return glm::dot(normal_, point - origin_); }

  // Replaces `to` by the part of a ring that is further than `clearance` in front of the plane
  // (side 1) or behind it (side -1): Sutherland & Hodgman (1974). Parts that are cut off one
  // another stay joined by edges in the plane, which enclose no area.
  void project(Ring const& ring, double side, std::vector<glm::dvec2>& to) const {
    to.clear();
    if (ring.empty()) return;
    glm::dvec3 from = ring.back();
    double from_beyond = side * height(from) - clearance;
    for (glm::dvec3 const& vertex : ring) {
      double const beyond = side * height(vertex) - clearance;
      if ((beyond > 0.0) != (from_beyond > 0.0)) {
        to.push_back(place(from + (vertex - from) * (from_beyond / (from_beyond - beyond))));
      }
      if (beyond > 0.0) to.push_back(place(vertex));
      from = vertex;
      from_beyond = beyond;
    }
  }

  // A ring of the receiver itself.
  void lay_out(Ring const& ring, PlaneFrame const& frame, std::vector<glm::dvec2>& to) const {
    to.clear();
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec3 const p = vertex - frame.origin;
      to.emplace_back(glm::dot(frame.u, p) / frame.width, glm::dot(frame.v, p) / frame.height);
    }
  }

 private:
  glm::dvec2 place(glm::dvec3 const& point) const {
    glm::dvec3 const p = point - origin_;
    return {glm::dot(x_, p), glm::dot(y_, p)};
  }

  glm::dvec3 origin_;
  glm::dvec3 normal_;
  glm::dvec3 x_{0.0};
  glm::dvec3 y_{0.0};
};

}  // namespace gpu_shading
