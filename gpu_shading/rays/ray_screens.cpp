#include "rays/ray_screens.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "filters/perforation/sheet_in_beam.h"
#include "filters/perforation/sheet_outline.h"
#include "filters/perforation/sheet_rays.h"
#include "gpu_shading/perforated_screen.h"
#include "rays/ray_shapes.h"

namespace gpu_shading {
namespace {

Box bounds_of(Screens::Entry const& entry) {
  Box box;
  for (Screens::Quadrilateral const& part : entry.parts) {
    for (glm::dvec3 const& corner : part.corners) {
      box.include(corner + entry.inside * entry.normal);
      box.include(corner + entry.outside * entry.normal);
    }
  }
  return with_margin(box);
}

bool has_table(PerforatedScreen const& screen) { return !screen.pattern(); }

// The effective transmittance of a sheet for a displacement; `place`: in the sheet's plane.
double effective(PerforatedScreen const& screen, glm::dvec2 const& shift, glm::dvec2 const& place) {
  if (!has_table(screen)) return screen.pattern()->transmittance(shift.x, shift.y);
  glm::dvec2 const size(screen.tile()->width(), screen.tile()->height());
  return screen.transmittance().at_place(glm::length(shift), std::atan2(shift.y, shift.x),
                                         glm::fract(place / size));
}

// What a ray meets of the parts of one sheet.
class Passage {
 public:
  Passage(Screens::Entry const& entry, RayPath const& ray)
      : entry_(entry), ray_(ray), cosine_(glm::dot(entry.normal, ray.direction)) {
    shift_ = glm::dvec2(glm::dot(entry.u, ray.direction), glm::dot(entry.v, ray.direction)) *
             ((entry.outside - entry.inside) / cosine_);
  }

  bool is_in_plane() const {
    constexpr double rounding = 1e-9;
    return std::abs(cosine_) < rounding;
  }
  bool is_aside() const { return std::abs(cosine_) < from_the_side; }
  glm::dvec2 const& shift() const { return shift_; }

  // Calls use(distance, place at the inside face, part of the path) for each part that it meets.
  template <typename Use>
  void each(Use const& use) const {
    for (Screens::Quadrilateral const& part : entry_.parts) {
      glm::dvec3 const& corner = part.corners.front();
      double const height = glm::dot(entry_.normal, corner - ray_.origin);
      double distance = height / cosine_;
      if (!is_between(distance)) {
        distance += 0.5 * (entry_.inside + entry_.outside) / cosine_;
        if (!is_between(distance)) continue;
      }
      glm::dvec3 const from_corner =
          ray_.origin + (height + entry_.inside) / cosine_ * ray_.direction - corner;
      glm::dvec2 const place = part.places.front() + glm::dvec2(glm::dot(from_corner, entry_.u),
                                                                glm::dot(from_corner, entry_.v));
      auto const within = SheetOutline(part.places, shift_).part_within(place);
      if (within) use(distance, place, *within);
    }
  }

 private:
  bool is_between(double distance) const {
    double const nearest = on_plane / std::abs(cosine_);
    return distance > nearest && ray_.length - distance > nearest;
  }

  Screens::Entry const& entry_;
  RayPath const& ray_;
  double cosine_;
  glm::dvec2 shift_{0.0};  // from the inside face to the outside face
};

}  // namespace

RayScreens::RayScreens(Scene const& scene, std::span<SurfaceId const> casters, ScreenDetail detail)
    : screens_(scene), detail_(detail) {
  std::vector<Box> boxes(screens_.entries().size());
  surfaces_.resize(boxes.size());
  for (SurfaceId const id : casters) {
    int const number = screens_.number(id);
    if (number == Screens::none) continue;
    auto const place = static_cast<std::size_t>(number);
    boxes[place] = bounds_of(screens_[number]);
    surfaces_[place] = id;
    PerforatedScreen const& screen = *screens_[number].screen;
    if (!by_holes(screen) && has_table(screen)) screen.transmittance();
  }
  tree_ = RayTree(boxes);
}

bool RayScreens::by_holes(PerforatedScreen const& screen) const {
  ScreenDetail const detail = detail_ == ScreenDetail::automatic ? screen.sheet().detail : detail_;
  return detail == ScreenDetail::holes;
}

std::optional<RayScreens::Met> RayScreens::meet(int number, RayPath const& ray,
                                                double limit) const {
  Screens::Entry const& entry = screens_[number];
  PerforatedScreen const& screen = *entry.screen;
  Passage const passage(entry, ray);
  if (passage.is_in_plane()) return std::nullopt;
  double nearest = std::numeric_limits<double>::infinity();
  double passed = passage.is_aside() ? 0.0 : 1.0;
  if (!passage.is_aside() && by_holes(screen)) {
    SheetInBeam const sheet = sheet_in_beam(entry, ray.direction, 1.0, false);
    bool const solid = sheet.layers == solid_sheet;
    std::optional<SheetRays> holes;
    if (!solid) holes.emplace(screen, sheet, 0.0, false);
    passage.each([&](double distance, glm::dvec2 const& place, SheetOutline::PathPart const& part) {
      nearest = std::min(nearest, distance);
      passed *= solid ? 0.0 : static_cast<double>(holes->part_of_way(place, part.begin, part.end));
    });
  } else {
    double length = 0.0;
    double begin = 1.0;
    double end = 0.0;
    glm::dvec2 at(0.0);
    passage.each([&](double distance, glm::dvec2 const& place, SheetOutline::PathPart const& part) {
      nearest = std::min(nearest, distance);
      length += part.end - part.begin;
      begin = std::min(begin, part.begin);
      end = std::max(end, part.end);
      at = place;
    });
    if (std::isfinite(nearest) && !passage.is_aside()) {
      // Parts overlap at the edges that they share.
      passed = effective(screen, std::min(length, 1.0) * passage.shift(),
                         at + 0.5 * (begin + end) * passage.shift());
    }
  }
  if (!std::isfinite(nearest) || nearest > limit) return std::nullopt;
  return Met{nearest, passed};
}

}  // namespace gpu_shading
