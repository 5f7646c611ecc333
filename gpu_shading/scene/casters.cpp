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
      : half_width_(0.5 * frame.width), half_height_(0.5 * frame.height) {
    double const cosine = glm::dot(frame.normal, towards_sun);
    slide_u_ = frame.u - frame.normal * (glm::dot(frame.u, towards_sun) / cosine);
    slide_v_ = frame.v - frame.normal * (glm::dot(frame.v, towards_sun) / cosine);
    origin_ = frame.origin;
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

  // Of the edge from a to b, what lies in the receiver's rectangle.
  Detail edge(glm::dvec3 const& a, glm::dvec3 const& b) const {
    glm::dvec2 const from = in_rectangle(a);
    glm::dvec2 const step = in_rectangle(b) - from;
    double enters = 0.0;
    double leaves = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      constexpr double rounding = 1e-9;
      if (std::abs(step[axis]) < rounding) {
        if (std::abs(from[axis]) > 0.5 - rounding) return {};
        continue;
      }
      double const low = (-0.5 - from[axis]) / step[axis];
      double const high = (0.5 - from[axis]) / step[axis];
      enters = std::max(enters, std::min(low, high));
      leaves = std::min(leaves, std::max(low, high));
    }
    if (leaves <= enters) return {};
    glm::dvec2 const length = (leaves - enters) * glm::abs(step);
    // Within a pixel of a row from end to end of the finest tile that is chosen by detail.
    constexpr double parallel = 1e-3;
    bool const along = std::min(length.x, length.y) < parallel * std::max(length.x, length.y);
    return along ? Detail{glm::length(length), 0.0} : Detail{0.0, glm::length(length)};
  }

  // Whether a box may throw one on the rectangle: all of it is taken, in front of the plane or not.
  bool may_come_from(Box const& box) const {
    glm::dvec3 const c = box.centre() - origin_;
    glm::dvec3 const r = box.reach();
    double const room = 1e-9 * (glm::length(c) + glm::length(r)) + 2.0 * slack();
    auto const misses = [&](glm::dvec3 const& slide, double half) {
      return std::abs(glm::dot(slide, c)) >
             glm::dot(glm::abs(slide), r) + half + room * (1.0 + glm::length(slide));
    };
    return !misses(slide_u_, half_width_) && !misses(slide_v_, half_height_);
  }

  bool overlaps() const {
    double const over = slack();
    return high_u_ >= -half_width_ - over && low_u_ <= half_width_ + over &&
           high_v_ >= -half_height_ - over && low_v_ <= half_height_ + over;
  }

 private:
  // Sides of the rectangle, from its middle.
  glm::dvec2 in_rectangle(glm::dvec3 const& point) const {
    glm::dvec3 const p = point - origin_;
    return {0.5 * glm::dot(slide_u_, p) / half_width_, 0.5 * glm::dot(slide_v_, p) / half_height_};
  }

  // Against rounding, here and in the float32 of the GPU.
  double slack() const { return 1e-6 * (half_width_ + half_height_); }

  double half_width_;
  double half_height_;
  glm::dvec3 origin_;
  glm::dvec3 slide_u_;
  glm::dvec3 slide_v_;
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
  auto const wanted = [&](Box const& box) {
    glm::dvec3 const c = box.centre() - frame.origin;
    double const highest =
        glm::dot(frame.normal, c) + glm::dot(glm::abs(frame.normal), box.reach());
    return highest > coplanar - 1e-12 * glm::length(c) && shadow.may_come_from(box);
  };
  auto const add_edges = [&](std::span<glm::dvec3 const> ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      found.detail += shadow.edge(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  tree_.search(wanted, [&](SurfaceId id) {
    Caster const& caster = casters_[id];
    if (!is_in_view(caster, frame, towards_sun, shadow) || !scene.may_shade(receiver, id)) return;
    found.casters.push_back(id);
    if (found.detail.total() >= enough) return;
    add_edges(points(caster));
    for (Ring const& hole : holes(caster)) add_edges(hole);
  });
  std::sort(found.casters.begin(), found.casters.end());
  return found;
}

bool Casters::is_in_view(Caster const& caster, PlaneFrame const& frame,
                         glm::dvec3 const& towards_sun, Shadow& shadow) const {
  if (caster.only_turned_away && glm::dot(caster.normal, towards_sun) > in_the_sun) return false;
  auto const ring = points(caster);
  shadow.clear();
  bool clearly_in_front = false;
  bool cut = false;
  for (glm::dvec3 const& vertex : ring) {
    clearly_in_front = clearly_in_front || height_above(frame, vertex) > coplanar;
    if (depth(frame, vertex) > 0.0) {
      shadow.include(vertex + caster.faces.inside * caster.normal);
      shadow.include(vertex + caster.faces.outside * caster.normal);
    } else {
      cut = true;
    }
  }
  if (!clearly_in_front) return false;
  bool const thick = caster.faces.inside != caster.faces.outside;
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
