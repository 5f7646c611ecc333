#include "filters/perforation/sheet_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "filters/perforation/mix.h"

namespace gpu_shading {
namespace {

// Linear interpolation between the values for thirds of the path.
float along(glm::vec4 const& thirds, float way) {
  float const places = 3.0F * way;
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

std::vector<double> depths_of(int layers) {
  if (layers == 1) return {0.5};
  std::vector<double> depths;
  depths.reserve(static_cast<std::size_t>(std::max(0, layers)));
  for (int k = 0; k < layers; ++k) depths.push_back(static_cast<double>(k) / (layers - 1));
  return depths;
}

}  // namespace

SheetRays::SheetRays(PerforatedScreen const& screen, SheetInBeam const& sheet, double pixel,
                     bool by_rows)
    : sheet_(sheet),
      ray_(sheet.way),
      tile_(sheet.tile),
      blend_(glm::smoothstep(sheet.blend_from, sheet.blend_to, static_cast<float>(pixel))),
      depths_(depths_of(sheet.layers)) {
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

void SheetRays::whole_ways(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                           Ways& passed) const {
  if (!pattern_) {
    for (std::size_t i = 0; i < passed.size(); ++i, wanted >>= 1U) {
      if ((wanted & 1U) == 0) continue;
      passed[i] = part_of_way(first + static_cast<double>(i) * step, 0.0, 1.0);
    }
    return;
  }
  if (blend_ == 1.0F) return find_by_effect(first, step, passed);
  find_through_holes(first, step, passed);
  if (blend_ == 0.0F) return;
  Ways by_effect;
  find_by_effect(first, step, by_effect);
  for (std::size_t i = 0; i < passed.size(); ++i) {
    passed[i] = mix(passed[i], by_effect[i], blend_);
  }
}

void SheetRays::find_through_holes(glm::dvec2 const& first, glm::dvec2 const& step,
                                   Ways& passed) const {
  if (sheet_.layers == exact_sheet) return pattern_->find_passing(first, step, ray_, passed);
  passed.fill(1.0F);
  Ways in_layer;
  for (double const depth : depths_) {
    pattern_->find_passing(first + depth * ray_, step, glm::dvec2(0.0), in_layer);
    for (std::size_t i = 0; i < passed.size(); ++i) passed[i] *= in_layer[i];
  }
}

void SheetRays::find_by_effect(glm::dvec2 const& first, glm::dvec2 const& step,
                               Ways& passed) const {
  if (rows_) return rows_->find(first, step, passed);
  passed.fill(sheet_.effective[3]);
}

float SheetRays::part_of_way(glm::dvec2 const& place, double begin, double end) const {
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
  auto const way = static_cast<float>(end - begin);
  if (sheet_.regions.empty()) return along(sheet_.effective, way);
  int const across = sheet_.regions_across;
  int const up = sheet_.regions_up;
  glm::dvec2 const middle = place + 0.5 * (begin + end) * ray_;
  glm::dvec2 const at = glm::fract(middle / tile_) * glm::dvec2(across, up) - 0.5;
  glm::dvec2 const corner = glm::floor(at);
  glm::vec2 const part(at - corner);
  auto const region = [&](int column, int row) {
    auto const number = around(row, up) * across + around(column, across);
    return along(sheet_.regions[static_cast<std::size_t>(number)], way);
  };
  int const left = static_cast<int>(corner.x);
  int const low = static_cast<int>(corner.y);
  float const below = mix(region(left, low), region(left + 1, low), part.x);
  float const above = mix(region(left, low + 1), region(left + 1, low + 1), part.x);
  return mix(below, above, part.y);
}

}  // namespace gpu_shading
