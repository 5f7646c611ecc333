#include "filters/perforation/sheet_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "filters/perforation/image_rays.h"
#include "filters/perforation/region_rays.h"
#include "filters/perforation/sheet_outline.h"

namespace gpu_shading {
namespace {

// Linear interpolation between the values for thirds of the path.
float along(glm::vec4 const& thirds, float share) {
  float const places = 3.0F * share;
  float sum = thirds[0];
  for (int i = 0; i < 3; ++i) {
    sum += (thirds[i + 1] - thirds[i]) * std::clamp(places - static_cast<float>(i), 0.0F, 1.0F);
  }
  return sum;
}

int around(int place, int count) {
  int const rest = place % count;
  return rest < 0 ? rest + count : rest;
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
  Passage(Screens::Entry const& entry, SheetRay const& ray)
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
    double const nearest = ray_.margin / std::abs(cosine_);
    return distance > nearest && ray_.length - distance > nearest;
  }

  Screens::Entry const& entry_;
  SheetRay const& ray_;
  double cosine_;
  glm::dvec2 shift_{0.0};  // from the inside face to the outside face
};

}  // namespace

SheetRays::SheetRays(PerforatedScreen const& screen, SheetInBeam const& sheet, double pixel,
                     bool by_rows)
    : sheet_(sheet),
      ray_(sheet.ray_offset),
      tile_(sheet.tile),
      blend_(glm::smoothstep(sheet.blend_from, sheet.blend_to, static_cast<float>(pixel))),
      depths_(layer_depths(sheet.layers)) {
  if (screen.pattern()) {
    pattern_.emplace(sheet);
    if (by_rows && blend_ > 0.0F && sheet.blend_from > 0.0F) rows_.emplace(sheet);
  } else {
    image_.emplace(*screen.tile(), sheet, depths_);
  }
}

std::optional<float> SheetRays::everywhere() const {
  if (blend_ == 1.0F && sheet_.regions.empty() && !rows_) return sheet_.effective[3];
  return std::nullopt;
}

void SheetRays::whole_paths(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                            Passed& passed) const {
  if (blend_ == 1.0F) return find_by_effect(first, step, passed);
  find_through_holes(first, step, wanted, passed);
  if (blend_ == 0.0F) return;
  Passed by_effect;
  find_by_effect(first, step, by_effect);
  for (std::size_t i = 0; i < passed.size(); ++i) {
    passed[i] = mix(passed[i], by_effect[i], blend_);
  }
}

void SheetRays::find_through_holes(glm::dvec2 const& first, glm::dvec2 const& step,
                                   std::uint64_t wanted, Passed& passed) const {
  if (image_) return image_->find_through(first, step, wanted, passed);
  if (sheet_.layers == exact_sheet) return pattern_->find_passing(first, step, ray_, passed);
  passed.fill(1.0F);
  Passed in_layer;
  for (double const depth : depths_) {
    pattern_->find_passing(first + depth * ray_, step, glm::dvec2(0.0), in_layer);
    for (std::size_t i = 0; i < passed.size(); ++i) passed[i] *= in_layer[i];
  }
}

void SheetRays::find_by_effect(glm::dvec2 const& first, glm::dvec2 const& step,
                               Passed& passed) const {
  if (rows_) return rows_->find(first, step, passed);
  if (!sheet_.regions.empty()) return find_by_region(sheet_, first, step, passed);
  passed.fill(sheet_.effective[3]);
}

float SheetRays::part_of_path(glm::dvec2 const& place, double begin, double end) const {
  float passed = 0.0F;
  if (blend_ < 1.0F) passed = through_holes(place, begin, end);
  if (blend_ > 0.0F) passed = mix(passed, through_effective(place, begin, end), blend_);
  return passed;
}

float SheetRays::solid_at(glm::dvec2 const& place) const {
  if (image_) return image_->solid_at(place);
  return pattern_->is_open(place) ? 0.0F : 1.0F;
}

float SheetRays::through_layers(glm::dvec2 const& place, double begin, double end) const {
  float most = 0.0F;
  auto const meet = [&](double depth) { most = std::max(most, solid_at(place + depth * ray_)); };
  if (!is_whole(begin, end)) {
    meet(begin);
    meet(end);
  }
  for (double const depth : depths_) {
    if (depth >= begin && depth <= end && most < 1.0F) meet(depth);
  }
  return 1.0F - most;
}

float SheetRays::through_holes(glm::dvec2 const& place, double begin, double end) const {
  if (pattern_ && sheet_.layers == exact_sheet) {
    return pattern_->passes(place + begin * ray_, (end - begin) * ray_) ? 1.0F : 0.0F;
  }
  if (image_ && is_whole(begin, end)) return image_->through(place);
  return through_layers(place, begin, end);
}

float SheetRays::through_effective(glm::dvec2 const& place, double begin, double end) const {
  if (rows_ && is_whole(begin, end)) return rows_->at(place);
  auto const share = static_cast<float>(end - begin);
  if (sheet_.regions.empty()) return along(sheet_.effective, share);
  int const across = sheet_.regions_across;
  int const up = sheet_.regions_up;
  glm::dvec2 const middle = place + 0.5 * (begin + end) * ray_;
  glm::dvec2 const at = glm::fract(middle / tile_) * glm::dvec2(across, up) - 0.5;
  glm::dvec2 const corner = glm::floor(at);
  glm::vec2 const part(at - corner);
  auto const region = [&](int column, int row) {
    auto const number = around(row, up) * across + around(column, across);
    return along(sheet_.regions[static_cast<std::size_t>(number)], share);
  };
  int const left = static_cast<int>(corner.x);
  int const low = static_cast<int>(corner.y);
  float const below = mix(region(left, low), region(left + 1, low), part.x);
  float const above = mix(region(left, low + 1), region(left + 1, low + 1), part.x);
  return mix(below, above, part.y);
}

std::optional<MetSheet> meet_sheet(Screens::Entry const& entry, SheetRay const& ray,
                                   bool by_holes) {
  PerforatedScreen const& screen = *entry.screen;
  Passage const passage(entry, ray);
  if (passage.is_in_plane()) return std::nullopt;
  double nearest = std::numeric_limits<double>::infinity();
  double passed = passage.is_aside() ? 0.0 : 1.0;
  if (!passage.is_aside() && by_holes) {
    SheetInBeam const sheet = sheet_in_beam(entry, ray.direction, 1.0, false);
    bool const solid = sheet.layers == solid_sheet;
    std::optional<SheetRays> holes;
    if (!solid) holes.emplace(screen, sheet, 0.0, false);
    passage.each([&](double distance, glm::dvec2 const& place, SheetOutline::PathPart const& part) {
      nearest = std::min(nearest, distance);
      passed *= solid ? 0.0 : static_cast<double>(holes->part_of_path(place, part.begin, part.end));
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
  if (!std::isfinite(nearest) || nearest > ray.limit) return std::nullopt;
  return MetSheet{nearest, passed};
}

}  // namespace gpu_shading
