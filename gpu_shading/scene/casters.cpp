#include "scene/casters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>

#include "scene/ring.h"

namespace gpu_shading {
namespace {

// The largest distance of a vertex from the plane through the first.
double warp(Ring const& ring, glm::dvec3 const& unit_normal) {
  double most = 0.0;
  for (glm::dvec3 const& vertex : ring) {
    most = std::max(most, std::abs(glm::dot(vertex - ring[0], unit_normal)));
  }
  return most;
}

double height_above(PlaneFrame const& frame, glm::dvec3 const& point) {
  return glm::dot(frame.normal, point - frame.origin);
}

double depth(PlaneFrame const& frame, glm::dvec3 const& point) {
  return height_above(frame, point) - clearance;
}

double middle(SheetFaces const& faces) { return 0.5 * (faces.inside + faces.outside); }

// With both faces of its sheet; empty where it cannot cast.
Box bounds_of(Surface const& surface) {
  Box box;
  if (surface.casting == Casting::never) return box;
  Ring const ring = without_repeats(surface.polygon.outline);
  glm::dvec3 const vector = newell(ring);
  if (ring.size() < 3 || is_degenerate(ring, vector)) return box;
  glm::dvec3 const normal = glm::normalize(vector);
  SheetFaces const faces = sheet_faces(surface);
  for (glm::dvec3 const& vertex : ring) {
    box.include(vertex + faces.inside * normal);
    box.include(vertex + faces.outside * normal);
  }
  return box;
}

// Sorts distinct ids below `end`. Many of them are marked in a bitmap, which takes a fraction of
// the time of comparing them: with 32,000 casters in view that was an eighth of culling.
void sort_ids(std::vector<SurfaceId>& ids, std::size_t end) {
  constexpr std::size_t word_bits = 64;
  std::size_t const words = end / word_bits + 1;
  if (ids.size() < words) return std::sort(ids.begin(), ids.end());
  static thread_local std::vector<std::uint64_t> marks;
  marks.assign(words, 0);
  for (SurfaceId const id : ids) marks[id / word_bits] |= std::uint64_t{1} << id % word_bits;
  auto next = ids.begin();
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t rest = marks[word]; rest != 0; rest &= rest - 1) {
      *next++ =
          static_cast<SurfaceId>(word * word_bits) + static_cast<SurfaceId>(std::countr_zero(rest));
    }
  }
}

}  // namespace

// Bounds of a projected caster in the receiver's plane, relative to the receiver's rectangle
// centred on the origin.
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

  // The point where the line from a to b crosses the plane, if it does.
  void include_crossing(PlaneFrame const& frame, glm::dvec3 const& a, glm::dvec3 const& b) {
    double const depth_a = depth(frame, a);
    double const depth_b = depth(frame, b);
    if ((depth_a > 0.0) == (depth_b > 0.0)) return;
    include(a + (b - a) * (depth_a / (depth_a - depth_b)));
  }

  // Adds the parts of a ring's edges inside the receiver's rectangle; with `within`, all of them.
  void add_edges(std::span<glm::dvec3 const> ring, bool within, Detail& detail) const {
    if (ring.empty()) return;
    glm::dvec2 from = in_rectangle(ring.back());
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec2 const to = in_rectangle(vertex);
      add_edge((within ? 1.0 : part_within(from, to - from)) * (to - from), detail);
      from = to;
    }
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

Casters::Casters(Scene const& scene) {
  std::vector<Box> boxes;
  boxes.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) boxes.push_back(bounds_of(scene[id]));
  tree_ = Bvh(boxes);
  casters_.reserve(tree_.order().size());
  for (SurfaceId const id : tree_.order()) add(id, scene[id]);
  if (scene.rule().empty()) return;
  for (Caster& caster : casters_) caster.role = scene.rule().roles[caster.id];
}

void Casters::add(SurfaceId id, Surface const& surface) {
  Ring const ring = without_repeats(surface.polygon.outline);
  Caster& caster = casters_.emplace_back();
  caster.id = id;
  caster.first = points_.size();
  caster.count = static_cast<std::uint32_t>(ring.size());
  caster.normal = glm::normalize(newell(ring));
  double const off = warp(ring, caster.normal);
  caster.planar = off <= 1e-6;
  caster.warped = off > 1e-3;  // more than models' coordinates are rounded by
  caster.faces = sheet_faces(surface);
  caster.only_turned_away = surface.casting == Casting::turned_away;
  points_.insert(points_.end(), ring.begin(), ring.end());
  caster.first_hole = holes_.size();
  caster.holes = surface.polygon.holes.size();
  holes_.insert(holes_.end(), surface.polygon.holes.begin(), surface.polygon.holes.end());
}

InView Casters::in_view(Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
                        glm::dvec3 const& towards_sun, double enough) const {
  InView found;
  Shadow shadow(frame, towards_sun);
  std::optional<ShadingRule::Receiver> rule;
  if (!scene.rule().empty()) rule.emplace(scene.rule(), receiver);
  auto const look_at = [&](Caster const& caster, bool inside) {
    if (caster.id == receiver || (rule && !rule->counts(caster.role))) return;
    if (caster.only_turned_away && glm::dot(caster.normal, towards_sun) > in_the_sun) return;
    if (!inside && !is_in_view(caster, frame, shadow)) return;
    found.casters.push_back(caster.id);
    found.warped = found.warped || caster.warped;
    if (found.detail.total() >= enough) return;
    shadow.add_edges(points(caster), inside, found.detail);
    for (Ring const& hole : holes(caster)) shadow.add_edges(hole, inside, found.detail);
  };
  tree_.search([&](glm::dvec3 const& centre,
                   glm::dvec3 const& reach) { return shadow.classify(centre, reach); },
               [&](std::uint32_t first, std::uint32_t count, Containment containment) {
                 for (std::uint32_t i = first; i < first + count; ++i) {
                   look_at(casters_[i], containment == Containment::inside);
                 }
               });
  sort_ids(found.casters, scene.size());
  return found;
}

bool Casters::is_in_view(Caster const& caster, PlaneFrame const& frame, Shadow& shadow) const {
  auto const ring = points(caster);
  bool const thick = caster.faces.inside != caster.faces.outside;
  // A sheet on the receiver is in front of it by its body, if not by its polygon.
  double const body = std::max(0.0, glm::dot(frame.normal, caster.normal) * middle(caster.faces));
  shadow.clear();
  bool clearly_in_front = false;
  bool cut = false;
  for (glm::dvec3 const& vertex : ring) {
    double const height = height_above(frame, vertex) + body;
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
    // Inner edges of triangles reach beyond the outline's own intersections.
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) shadow.include_crossing(frame, ring[i], ring[j]);
    }
  }
  return shadow.overlaps();
}

}  // namespace gpu_shading
