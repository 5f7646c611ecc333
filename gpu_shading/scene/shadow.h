#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "geometry/bvh.h"
#include "geometry/plane_frame.h"
#include "scene/casters.h"
#include "scene/turns.h"

namespace gpu_shading {

inline double height_above(PlaneFrame const& frame, glm::dvec3 const& point) {
  return glm::dot(frame.normal, point - frame.origin);
}

// Bounds of a projected caster in the receiver's plane, relative to the receiver's rectangle
// centred on the origin.
class Shadow {
 public:
  Shadow(PlaneFrame const& frame, glm::dvec3 const& towards_sun)
      : half_width_(0.5 * frame.width),
        half_height_(0.5 * frame.height),
        of_width_(1.0 / frame.width),
        of_height_(1.0 / frame.height) {
    double const cosine = glm::dot(frame.normal, towards_sun);
    slide_u_ = frame.u - frame.normal * (glm::dot(frame.u, towards_sun) / cosine);
    slide_v_ = frame.v - frame.normal * (glm::dot(frame.v, towards_sun) / cosine);
    origin_ = frame.origin;
    normal_ = frame.normal;
    abs_u_ = glm::abs(slide_u_);
    abs_v_ = glm::abs(slide_v_);
    abs_normal_ = glm::abs(normal_);
    steepness_ = 1.0 + std::max(glm::length(slide_u_), glm::length(slide_v_));
  }

  void clear() {
    low_u_ = low_v_ = std::numeric_limits<double>::infinity();
    high_u_ = high_v_ = -std::numeric_limits<double>::infinity();
  }

  void include(glm::dvec3 const& point) {
    glm::dvec3 const p = point - origin_;
    double const u = glm::dot(slide_u_, p);
    double const v = glm::dot(slide_v_, p);
    low_u_ = std::min(low_u_, u);
    high_u_ = std::max(high_u_, u);
    low_v_ = std::min(low_v_, v);
    high_v_ = std::max(high_v_, v);
  }

  // The point where the line from a to b crosses the plane, if it does.
  void include_crossing(PlaneFrame const& frame, glm::dvec3 const& a, glm::dvec3 const& b) {
    double const height_a = height_above(frame, a);
    double const height_b = height_above(frame, b);
    if ((height_a > 0.0) == (height_b > 0.0)) return;
    include(a + (b - a) * (height_a / (height_a - height_b)));
  }

  // Adds the parts of a ring's edges inside the receiver's rectangle.
  void add_edges(std::span<glm::dvec3 const> ring, Detail& detail) const {
    if (ring.empty()) return;
    glm::dvec2 from = in_rectangle(ring.back());
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec2 const to = in_rectangle(vertex);
      add_edge(part_within(from, to - from) * (to - from), detail);
      from = to;
    }
  }

  struct Size {
    double area = 0.0;
    double longest_edge = 0.0;
  };

  // Of a ring, in the rectangle's area and lengths of its sides, also where it is outside of it.
  Size size(std::span<glm::dvec3 const> ring) const {
    Size size;
    if (ring.empty()) return size;
    glm::dvec2 const first = in_rectangle(ring.front());
    glm::dvec2 from = in_rectangle(ring.back());
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec2 const to = in_rectangle(vertex);
      glm::dvec2 const a = from - first;
      glm::dvec2 const b = to - first;
      size.area += 0.5 * (a.x * b.y - a.y * b.x);
      size.longest_edge = std::max(size.longest_edge, glm::length(to - from));
      from = to;
    }
    size.area = std::abs(size.area);
    return size;
  }

  // How much of a box may cast a shadow on the rectangle; intersecting where rounding decides.
  Containment classify(glm::dvec3 const& centre, glm::dvec3 const& reach) const {
    glm::dvec3 const c = centre - origin_;
    double const size = glm::dot(glm::abs(c) + reach, glm::dvec3(1.0));
    double const rounding = 1e-12 * size;
    double const height = glm::dot(normal_, c);
    double const height_reach = glm::dot(abs_normal_, reach);
    if (height + height_reach <= coplanar - rounding) return Containment::outside;
    double const u = std::abs(glm::dot(slide_u_, c));
    double const v = std::abs(glm::dot(slide_v_, c));
    double const u_reach = glm::dot(abs_u_, reach);
    double const v_reach = glm::dot(abs_v_, reach);
    double const room = (1e-9 * size + 2.0 * slack()) * steepness_;
    if (u > u_reach + half_width_ + room || v > v_reach + half_height_ + room)
      return Containment::outside;
    bool const inside = height - height_reach > coplanar + rounding &&
                        u + u_reach < half_width_ - room && v + v_reach < half_height_ - room;
    return inside ? Containment::inside : Containment::intersecting;
  }

  bool overlaps() const {
    double const over = slack();
    return high_u_ >= -half_width_ - over && low_u_ <= half_width_ + over &&
           high_v_ >= -half_height_ - over && low_v_ <= half_height_ + over;
  }

 private:
  // In lengths of the rectangle's sides, from its centre.
  glm::dvec2 in_rectangle(glm::dvec3 const& point) const {
    glm::dvec3 const p = point - origin_;
    return {glm::dot(slide_u_, p) * of_width_, glm::dot(slide_v_, p) * of_height_};
  }

  // The part of a line inside the rectangle, with the line in lengths of the rectangle's sides.
  static double part_within(glm::dvec2 const& from, glm::dvec2 const& step) {
    double enters = 0.0;
    double leaves = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      constexpr double rounding = 1e-9;
      if (std::abs(step[axis]) < rounding) {
        if (std::abs(from[axis]) > 0.5 - rounding) return 0.0;
        continue;
      }
      double const low = (-0.5 - from[axis]) / step[axis];
      double const high = (0.5 - from[axis]) / step[axis];
      enters = std::max(enters, std::min(low, high));
      leaves = std::min(leaves, std::max(low, high));
    }
    return std::max(leaves - enters, 0.0);
  }

  static void add_edge(glm::dvec2 const& edge, Detail& detail) {
    // Within a pixel of a row from end to end of the finest tile that is chosen by detail.
    constexpr double parallel = 1e-3;
    glm::dvec2 const size = glm::abs(edge);
    double const length = glm::length(edge);
    if (length == 0.0) return;  // outside
    if (std::min(size.x, size.y) < parallel * std::max(size.x, size.y)) {
      detail.along += length;
      return;
    }
    detail.across += length;
    auto const& shares = in_step(edge);
    for (std::size_t turn = 0; turn < turns; ++turn) detail.in_step[turn] += shares[turn] * length;
  }

  // A margin for rounding, here and in the GPU's single precision.
  double slack() const { return 1e-6 * (half_width_ + half_height_); }

  double half_width_;
  double half_height_;
  double of_width_;
  double of_height_;
  glm::dvec3 origin_;
  glm::dvec3 normal_;
  glm::dvec3 slide_u_;
  glm::dvec3 slide_v_;
  glm::dvec3 abs_normal_;
  glm::dvec3 abs_u_;
  glm::dvec3 abs_v_;
  double steepness_;
  double low_u_ = 0.0;
  double high_u_ = 0.0;
  double low_v_ = 0.0;
  double high_v_ = 0.0;
};

// Where a box may cast a shadow on a receiver's rectangle from any direction of a sector.
class SectorShadow {
 public:
  SectorShadow(PlaneFrame const& frame, SunSector const& sector)
      : frame_(frame),
        sector_(sector),
        abs_u_(glm::abs(frame.u)),
        abs_v_(glm::abs(frame.v)),
        abs_normal_(glm::abs(frame.normal)) {}

  // Conservative, with room for rounding.
  bool may_overlap(glm::dvec3 const& centre, glm::dvec3 const& reach) const {
    glm::dvec3 const c = centre - frame_.origin;
    double const height = glm::dot(frame_.normal, c);
    double const height_reach = glm::dot(abs_normal_, reach);
    double const top = height + height_reach;
    if (top <= 0.0) return false;
    double const base = std::max(0.0, height - height_reach);
    double const room =
        1e-5 * (frame_.width + frame_.height) + 1e-9 * (glm::length(c) + glm::length(reach));
    return overlaps(glm::dot(frame_.u, c), glm::dot(abs_u_, reach) + room, base, top, 0,
                    0.5 * frame_.width) &&
           overlaps(glm::dot(frame_.v, c), glm::dot(abs_v_, reach) + room, base, top, 1,
                    0.5 * frame_.height);
  }

 private:
  // An object at x, extending `reach` to both sides and between two heights, has its shadow at
  // x - height * tangent.
  bool overlaps(double x, double reach, double base, double top, int axis, double half) const {
    double const max_shift = std::max(base * sector_.high[axis], top * sector_.high[axis]);
    double const min_shift = std::min(base * sector_.low[axis], top * sector_.low[axis]);
    return x - reach - max_shift <= half && x + reach - min_shift >= -half;
  }

  PlaneFrame const& frame_;
  SunSector const& sector_;
  glm::dvec3 abs_u_;
  glm::dvec3 abs_v_;
  glm::dvec3 abs_normal_;
};

}  // namespace gpu_shading
