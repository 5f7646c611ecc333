#include "scene/casters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

// Bounds of a slid caster in the receiver's plane, against the receiver's rectangle about the
// origin.
class Shadow {
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

  bool overlaps() const {
    // Against rounding, here and in the float32 of the GPU.
    double const slack = 1e-6 * (half_width_ + half_height_);
    return high_u_ >= -half_width_ - slack && low_u_ <= half_width_ + slack &&
           high_v_ >= -half_height_ - slack && low_v_ <= half_height_ + slack;
  }

 private:
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

double height_above(PlaneFrame const& frame, glm::dvec3 const& point) {
  return glm::dot(frame.normal, point - frame.origin);
}

double depth(PlaneFrame const& frame, glm::dvec3 const& point) {
  return height_above(frame, point) - clearance;
}

void include_crossing(Shadow& shadow, PlaneFrame const& frame, glm::dvec3 const& a,
                      glm::dvec3 const& b) {
  double const depth_a = depth(frame, a);
  double const depth_b = depth(frame, b);
  if ((depth_a > 0.0) == (depth_b > 0.0)) return;
  shadow.include(a + (b - a) * (depth_a / (depth_a - depth_b)));
}

}  // namespace

Casters::Casters(Scene const& scene) {
  casters_.resize(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
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
      caster.centre += (vertex - ring[0]) / static_cast<double>(ring.size());
    }
    caster.centre += ring[0];
    for (glm::dvec3 const& vertex : ring) {
      caster.radius = std::max(caster.radius, glm::distance(vertex, caster.centre));
    }
    points_.insert(points_.end(), ring.begin(), ring.end());
  }
}

std::vector<SurfaceId> Casters::in_front(Scene const& scene, SurfaceId receiver,
                                         PlaneFrame const& frame) const {
  std::vector<SurfaceId> found;
  for (SurfaceId id = 0; id < casters_.size(); ++id) {
    Caster const& caster = casters_[id];
    if (caster.count == 0) continue;
    if (height_above(frame, caster.centre) + caster.radius <= coplanar) continue;
    auto const ring = points(caster);
    bool const in_front = std::any_of(ring.begin(), ring.end(), [&](glm::dvec3 const& vertex) {
      return height_above(frame, vertex) > coplanar;
    });
    if (in_front && scene.may_shade(receiver, id)) found.push_back(id);
  }
  return found;
}

std::vector<SurfaceId> Casters::in_view(std::span<SurfaceId const> candidates,
                                        PlaneFrame const& frame,
                                        glm::dvec3 const& towards_sun) const {
  std::vector<SurfaceId> found;
  Shadow shadow(frame, towards_sun);
  double const radius = 0.5 * std::hypot(frame.width, frame.height);
  for (SurfaceId const id : candidates) {
    Caster const& caster = casters_[id];
    if (caster.only_turned_away && glm::dot(caster.normal, towards_sun) > in_the_sun) continue;
    // The bounding spheres as the sun sees them.
    glm::dvec3 const apart = caster.centre - frame.origin;
    double const along = glm::dot(apart, towards_sun);
    bool const thick = caster.faces.inside != caster.faces.outside;
    double const reach = radius + caster.radius +
                         std::max(std::abs(caster.faces.inside), std::abs(caster.faces.outside));
    double const rounding = 1e-12 * glm::dot(apart, apart);
    if (glm::dot(apart, apart) - along * along > reach * reach + rounding) continue;

    auto const ring = points(caster);
    shadow.clear();
    bool cut = false;
    for (glm::dvec3 const& vertex : ring) {
      if (depth(frame, vertex) > 0.0) {
        shadow.include(vertex + caster.faces.inside * caster.normal);
        shadow.include(vertex + caster.faces.outside * caster.normal);
      } else {
        cut = true;
      }
    }
    if (cut && caster.planar) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        include_crossing(shadow, frame, ring[i], ring[(i + 1) % ring.size()]);
      }
    } else if (cut) {
      // The triangles' inner edges reach outside the outline's own crossings.
      for (std::size_t i = 0; i < ring.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) include_crossing(shadow, frame, ring[i], ring[j]);
      }
    }
    if (shadow.overlaps() || (cut && thick)) found.push_back(id);
  }
  return found;
}

}  // namespace gpu_shading
