#include "support/perforated_case.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "support/plane_ring.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

glm::dvec3 unit_normal(Ring const& ring) {
  return glm::normalize(glm::cross(ring[1] - ring[0], ring[2] - ring[1]));
}

struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// The interval of the line through `point`, in lengths of `along` from there.
template <typename HalfPlanes>
Interval on_line(HalfPlanes const& planes, glm::dvec2 const& point, glm::dvec2 const& along) {
  Interval kept;
  for (auto const& plane : planes) {
    double const left = plane.limit - glm::dot(plane.normal, point);
    double const rate = glm::dot(plane.normal, along);
    if (rate > 0.0) {
      kept.high = std::min(kept.high, left / rate);
    } else if (rate < 0.0) {
      kept.low = std::max(kept.low, left / rate);
    } else if (left < 0.0) {
      kept.high = kept.low;
    }
  }
  return kept;
}

// The overlap of two circles at this distance.
double lens(double radius, double apart) {
  if (apart >= 2.0 * radius) return 0.0;
  double const half = apart / 2.0;
  return 2.0 * (radius * radius * std::acos(half / radius) -
                half * std::sqrt(radius * radius - half * half));
}

}  // namespace

double PerforatedCase::pitch() const {
  return hole * std::sqrt(pi / (2.0 * std::sqrt(3.0)) / open_fraction);
}

HolePattern PerforatedCase::pattern() const {
  return HolePattern({.hole = Hole::Round,
                      .arrangement = Arrangement::Staggered60,
                      .size = hole,
                      .pitch = pitch()});
}

Scene PerforatedCase::scene(std::shared_ptr<PerforatedScreen const> screen) const {
  Scene scene;
  scene.add({"receiver", receiver});
  Surface surface{"sheet", sheet};
  surface.filter.set(PerforatedSheet{std::move(screen), placement});
  scene.add(surface);
  return scene;
}

PerforatedReference::PerforatedReference(PerforatedCase const& given)
    : normal_(unit_normal(given.receiver.outline)),
      radius_(given.hole / 2.0),
      thickness_(given.thickness) {
  Ring const& ring = given.sheet.outline;
  glm::dvec3 const outwards = unit_normal(ring);
  glm::dvec3 const edge = glm::normalize(ring[2] - ring[1]);
  glm::dvec3 const across = glm::cross(outwards, edge);
  glm::dvec3 const origin =
      ring[1] + given.placement.origin_u * edge + given.placement.origin_v * across;
  u_ = std::cos(given.placement.rotation) * edge + std::sin(given.placement.rotation) * across;
  v_ = glm::cross(outwards, u_);

  // Distances of the sheet's faces from its polygon, along its normal.
  double inside = 0.0;
  if (given.plane == SheetPlane::centre) inside = -thickness_ / 2.0;
  if (given.plane == SheetPlane::outside) inside = -thickness_;
  double const up = glm::dot(outwards, normal_) > 0.0 ? 1.0 : -1.0;
  near_ = glm::dot(normal_, ring[0] - given.receiver.outline[0]) +
          std::min(up * inside, up * (inside + thickness_));

  auto const in_tile = [&](Ring const& corners) {
    std::vector<glm::dvec2> places;
    for (glm::dvec3 const& corner : corners) {
      places.emplace_back(glm::dot(corner - origin, u_), glm::dot(corner - origin, v_));
    }
    if (signed_area(places) < 0.0) std::reverse(places.begin(), places.end());
    return places;
  };
  receiver_ = in_tile(given.receiver.outline);
  sheet_ = in_tile(ring);
  outline_ = half_planes(sheet_);

  glm::dvec2 low = sheet_[0];
  glm::dvec2 high = sheet_[0];
  for (glm::dvec2 const& corner : sheet_) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  double const pitch = given.pitch();
  double const rows = std::sqrt(0.75) * pitch;
  for (int row = static_cast<int>(std::floor(low.y / rows)) - 1; row * rows <= high.y + radius_;
       ++row) {
    double const offset = row % 2 == 0 ? 0.0 : pitch / 2.0;
    for (int i = static_cast<int>(std::floor(low.x / pitch)) - 2;
         i * pitch + offset <= high.x + radius_; ++i) {
      add_hole({i * pitch + offset, row * rows});
    }
  }
}

std::vector<PerforatedReference::HalfPlane> PerforatedReference::half_planes(
    std::vector<glm::dvec2> const& ring) {
  std::vector<HalfPlane> planes;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec2 const edge = glm::normalize(ring[(i + 1) % ring.size()] - ring[i]);
    glm::dvec2 const outwards(edge.y, -edge.x);
    planes.push_back({outwards, glm::dot(outwards, ring[i])});
  }
  return planes;
}

void PerforatedReference::add_hole(glm::dvec2 const& centre) {
  Hole hole{centre, {}};
  bool inside = true;
  for (std::size_t i = 0; i < sheet_.size(); ++i) {
    HalfPlane const& plane = outline_[i];
    double const depth = plane.limit - glm::dot(plane.normal, centre);
    if (depth <= -radius_) return;
    if (depth >= radius_) continue;
    inside = false;
    glm::dvec2 const foot = centre + depth * plane.normal;
    double const half = std::sqrt(radius_ * radius_ - depth * depth);
    glm::dvec2 const along(-plane.normal.y, plane.normal.x);
    hole.breaks.push_back(foot + half * along);
    hole.breaks.push_back(foot - half * along);
    if (glm::distance(sheet_[i], centre) < radius_) hole.breaks.push_back(sheet_[i]);
  }
  if (inside) {
    whole_.push_back(centre);
  } else {
    cut_.push_back(std::move(hole));
  }
}

double PerforatedReference::operator()(SunDirection sun) const {
  glm::dvec3 const towards_sun = to_vector(sun);
  double const cosine = glm::dot(normal_, towards_sun);
  if (cosine <= 0.0) return 0.0;
  glm::dvec2 const slope(glm::dot(u_, towards_sun) / cosine, glm::dot(v_, towards_sun) / cosine);
  std::vector<glm::dvec2> seen = receiver_;
  for (glm::dvec2& corner : seen) corner += near_ * slope;
  Rays rays{thickness_ * slope, {1.0, 0.0}, half_planes(seen)};
  if (glm::length(slope) > 0.0) rays.along = glm::normalize(slope);

  double lit = signed_area(seen) - shaded_by_solid(seen, rays) + through_whole(rays);
  for (Hole const& hole : cut_) lit += through_one(hole, rays);
  return cosine * lit / signed_area(seen);
}

// The shifted outline as half planes: its own, and two along the shift.
double PerforatedReference::shaded_by_solid(std::vector<glm::dvec2> seen, Rays const& rays) const {
  std::vector<HalfPlane> hull = outline_;
  for (HalfPlane& plane : hull) {
    plane.limit += std::max(0.0, -glm::dot(plane.normal, rays.shift));
  }
  glm::dvec2 const aside(-rays.along.y, rays.along.x);
  for (glm::dvec2 const& normal : {aside, -aside}) {
    double limit = -std::numeric_limits<double>::infinity();
    for (glm::dvec2 const& corner : sheet_) limit = std::max(limit, glm::dot(normal, corner));
    hull.push_back({normal, limit});
  }
  for (HalfPlane const& plane : hull) {
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      glm::dvec2 const& a = seen[i];
      glm::dvec2 const& b = seen[(i + 1) % seen.size()];
      double const inside_a = plane.limit - glm::dot(plane.normal, a);
      double const inside_b = plane.limit - glm::dot(plane.normal, b);
      if (inside_a >= 0.0) kept.push_back(a);
      if ((inside_a >= 0.0) != (inside_b >= 0.0)) {
        kept.push_back(a + (b - a) * (inside_a / (inside_a - inside_b)));
      }
    }
    seen = std::move(kept);
  }
  return signed_area(seen);
}

double PerforatedReference::through_whole(Rays const& rays) const {
  double const each = lens(radius_, glm::length(rays.shift));
  if (each == 0.0) return 0.0;
  std::size_t inside = 0;
  double sum = 0.0;
  for (glm::dvec2 const& centre : whole_) {
    // The lens is the overlap of the hole and the shifted hole.
    bool within = true;
    bool outside = false;
    for (HalfPlane const& plane : rays.seen) {
      double const depth = plane.limit - glm::dot(plane.normal, centre) +
                           std::max(0.0, glm::dot(plane.normal, rays.shift));
      double const other = plane.limit - glm::dot(plane.normal, centre) +
                           std::min(0.0, glm::dot(plane.normal, rays.shift));
      within = within && depth >= radius_;
      outside = outside || other <= -radius_;
    }
    if (within) {
      ++inside;
    } else if (!outside) {
      sum += through_one({centre, {}}, rays);
    }
  }
  return sum + static_cast<double>(inside) * each;
}

// Lines at radius x sin(angle) from the centre, so that the integrand is smooth at the rim.
double PerforatedReference::through_one(Hole const& hole, Rays const& rays) const {
  glm::dvec2 const aside(-rays.along.y, rays.along.x);
  std::vector<double> angles{-pi / 2.0, pi / 2.0};
  for (glm::dvec2 const& at : hole.breaks) {
    angles.push_back(std::asin(std::clamp(glm::dot(aside, at - hole.centre) / radius_, -1.0, 1.0)));
  }
  // The ends of the lens through which a hole transmits.
  double const shift = glm::length(rays.shift);
  if (shift < 2.0 * radius_) {
    double const end = std::acos(shift / 2.0 / radius_);
    angles.push_back(end);
    angles.push_back(-end);
  }
  std::sort(angles.begin(), angles.end());
  double sum = 0.0;
  for (std::size_t piece = 0; piece + 1 < angles.size(); ++piece) {
    double const width = angles[piece + 1] - angles[piece];
    if (width < 1e-9) continue;
    int const lines = std::max(16, static_cast<int>(std::ceil(64.0 * width / pi)));
    for (int i = 0; i < lines; ++i) {
      double const angle = angles[piece] + width * (i + 0.5) / lines;
      double const half = radius_ * std::cos(angle);
      glm::dvec2 const middle = hole.centre + radius_ * std::sin(angle) * aside;
      Interval const sheet = on_line(outline_, middle, rays.along);
      double const from = std::max(-half, sheet.low);
      double const to = std::min(half, sheet.high);
      if (from >= to) continue;
      // Rays may enter or leave anywhere through the sheet's side.
      double const first = sheet.low > -half ? from - shift : from;
      double const last = sheet.high < half ? to : to - shift;
      Interval const seen = on_line(rays.seen, middle, rays.along);
      double const lit = std::min(last, seen.high) - std::max(first, seen.low);
      sum += std::max(0.0, lit) * half * width / lines;
    }
  }
  return sum;
}

}  // namespace gpu_shading
