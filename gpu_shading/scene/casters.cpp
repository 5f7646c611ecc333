#include "scene/casters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "scene/ring.h"

namespace gpu_shading {
namespace {

bool is_planar(Ring const& ring, glm::dvec3 const& unit_normal) {
  constexpr double flat = 1e-6;
  return std::all_of(ring.begin(), ring.end(), [&](glm::dvec3 const& vertex) {
    return std::abs(glm::dot(vertex - ring[0], unit_normal)) <= flat;
  });
}

double height_above(PlaneFrame const& frame, glm::dvec3 const& point) {
  return glm::dot(frame.normal, point - frame.origin);
}

double depth(PlaneFrame const& frame, glm::dvec3 const& point) {
  return height_above(frame, point) - clearance;
}

}  // namespace

// Bounds of a slid caster in the receiver's plane, against the receiver's rectangle about the
// origin.
class Casters::Shadow {
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

  // Where the line from a to b crosses the plane, if it does.
  void include_crossing(PlaneFrame const& frame, glm::dvec3 const& a, glm::dvec3 const& b) {
    double const depth_a = depth(frame, a);
    double const depth_b = depth(frame, b);
    if ((depth_a > 0.0) == (depth_b > 0.0)) return;
    include(a + (b - a) * (depth_a / (depth_a - depth_b)));
  }

  // Of a ring's edges, what lies in the receiver's rectangle; `within` it, all of them.
  Detail edges(std::span<glm::dvec3 const> ring, bool within) const {
    Detail detail;
    if (ring.empty()) return detail;
    glm::dvec2 from = in_rectangle(ring.back());
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec2 const to = in_rectangle(vertex);
      detail += detail_of((within ? 1.0 : part_within(from, to - from)) * glm::abs(to - from));
      from = to;
    }
    return detail;
  }

  // Of a box, how much may throw one on the rectangle. A part, too, where rounding has the word.
  Wanted of(glm::dvec3 const& centre, glm::dvec3 const& reach) const {
    glm::dvec3 const c = centre - origin_;
    double const size = glm::dot(glm::abs(c) + reach, glm::dvec3(1.0));
    double const rounding = 1e-12 * size;
    double const height = glm::dot(normal_, c);
    double const height_reach = glm::dot(abs_normal_, reach);
    if (height + height_reach <= coplanar - rounding) return Wanted::none;
    double const u = std::abs(glm::dot(slide_u_, c));
    double const v = std::abs(glm::dot(slide_v_, c));
    double const u_reach = glm::dot(abs_u_, reach);
    double const v_reach = glm::dot(abs_v_, reach);
    double const room = (1e-9 * size + 2.0 * slack()) * steepness_;
    if (u > u_reach + half_width_ + room || v > v_reach + half_height_ + room) return Wanted::none;
    bool const all = height - height_reach > coplanar + rounding &&
                     u + u_reach < half_width_ - room && v + v_reach < half_height_ - room;
    return all ? Wanted::all : Wanted::part;
  }

  bool overlaps() const {
    double const over = slack();
    return high_u_ >= -half_width_ - over && low_u_ <= half_width_ + over &&
           high_v_ >= -half_height_ - over && low_v_ <= half_height_ + over;
  }

 private:
  // In sides of the rectangle, from its middle.
  glm::dvec2 in_rectangle(glm::dvec3 const& point) const {
    glm::dvec3 const p = point - origin_;
    return {glm::dot(slide_u_, p) * of_width_, glm::dot(slide_v_, p) * of_height_};
  }

  // Of a line in the rectangle's sides, the part that lies in it.
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

  static Detail detail_of(glm::dvec2 const& length) {
    // Within a pixel of a row from end to end of the finest tile that is chosen by detail.
    constexpr double parallel = 1e-3;
    bool const along = std::min(length.x, length.y) < parallel * std::max(length.x, length.y);
    return along ? Detail{glm::length(length), 0.0} : Detail{0.0, glm::length(length)};
  }

  // Against rounding, here and in the float32 of the GPU.
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

Casters::Casters(Scene const& scene) {
  casters_.resize(scene.size());
  std::vector<Box> boxes(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].casting == Casting::never) continue;
    Ring const ring = without_repeats(scene[id].polygon.outline);
    glm::dvec3 const vector = newell(ring);
    if (ring.size() < 3 || is_degenerate(ring, vector)) continue;
    Caster& caster = casters_[id];
    caster.first = points_.size();
    caster.count = ring.size();
    caster.normal = glm::normalize(vector);
    caster.planar = is_planar(ring, caster.normal);
    caster.faces = sheet_faces(scene[id]);
    caster.only_turned_away = scene[id].casting == Casting::turned_away;
    for (glm::dvec3 const& vertex : ring) {
      boxes[id].include(vertex + caster.faces.inside * caster.normal);
      boxes[id].include(vertex + caster.faces.outside * caster.normal);
    }
    points_.insert(points_.end(), ring.begin(), ring.end());
    caster.first_hole = holes_.size();
    caster.holes = scene[id].polygon.holes.size();
    holes_.insert(holes_.end(), scene[id].polygon.holes.begin(), scene[id].polygon.holes.end());
  }
  tree_ = BoxTree(boxes);
}

InView Casters::in_view(Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
                        glm::dvec3 const& towards_sun, double enough) const {
  InView found;
  Shadow shadow(frame, towards_sun);
  auto const wanted = [&](glm::dvec3 const& centre, glm::dvec3 const& reach) {
    return shadow.of(centre, reach);
  };
  tree_.search(wanted, [&](SurfaceId id, Wanted how_much) {
    Caster const& caster = casters_[id];
    if (caster.only_turned_away && glm::dot(caster.normal, towards_sun) > in_the_sun) return;
    if (how_much == Wanted::part && !is_in_view(caster, frame, shadow)) return;
    if (!scene.may_shade(receiver, id)) return;
    found.casters.push_back(id);
    if (found.detail.total() >= enough) return;
    bool const within = how_much == Wanted::all;
    found.detail += shadow.edges(points(caster), within);
    for (Ring const& hole : holes(caster)) found.detail += shadow.edges(hole, within);
  });
  std::sort(found.casters.begin(), found.casters.end());
  return found;
}

bool Casters::is_in_view(Caster const& caster, PlaneFrame const& frame, Shadow& shadow) const {
  auto const ring = points(caster);
  bool const thick = caster.faces.inside != caster.faces.outside;
  shadow.clear();
  bool clearly_in_front = false;
  bool cut = false;
  for (glm::dvec3 const& vertex : ring) {
    double const height = height_above(frame, vertex);
    clearly_in_front = clearly_in_front || height > coplanar;
    if (height > clearance) {
      shadow.include(vertex + caster.faces.inside * caster.normal);
      if (thick) shadow.include(vertex + caster.faces.outside * caster.normal);
    } else {
      cut = true;
    }
  }
  if (!clearly_in_front) return false;
  if (cut && thick) return true;
  if (cut && caster.planar) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      shadow.include_crossing(frame, ring[i], ring[(i + 1) % ring.size()]);
    }
  } else if (cut) {
    // The triangles' inner edges reach outside the outline's own crossings.
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) shadow.include_crossing(frame, ring[i], ring[j]);
    }
  }
  return shadow.overlaps();
}

}  // namespace gpu_shading
