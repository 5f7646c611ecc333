#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "render/image_rays.h"
#include "render/pattern_rays.h"
#include "render/screen_view.h"

namespace gpu_shading {

// What passes a screen at one direction of the sun, ray by ray on the CPU: by the same rule as
// screen.frag, in which the terms are explained.
class SheetRays {
 public:
  // `sheet`: not a solid one. `regions`: as the sheet's numbers are. `pixel`: the size of pixels in
  // the sheet's plane, m. All must outlive it.
  SheetRays(PerforatedScreen const& screen, SheetBlock const& sheet,
            std::span<glm::vec4 const> regions, double pixel);

  // Of the way from face to face, where it is the same at all places.
  std::optional<float> everywhere() const;

  // Of the way from face to face of rays that pass the inside face at `first` and at equal steps
  // from there, m in the sheet's plane; of those whose bit is set in `wanted`, the lowest bit
  // first.
  static constexpr int most_ways = PatternRays::most;
  using Ways = PatternRays::Ways;
  void whole_ways(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                  Ways& passed) const;

  // Of a part of the way, 0 at the inside face and 1 at the outside one.
  float part_of_way(glm::dvec2 const& place, double begin, double end) const;

 private:
  bool is_whole(double begin, double end) const { return begin <= 0.0 && end >= 1.0; }
  float solid_at(glm::dvec2 const& place) const;
  float through_layers(glm::dvec2 const& place, double begin, double end) const;
  float through_holes(glm::dvec2 const& place, double begin, double end) const;
  float through_effective(glm::dvec2 const& place, double begin, double end) const;

  SheetBlock const& sheet_;
  std::span<glm::vec4 const> regions_;
  glm::dvec2 ray_;
  glm::dvec2 tile_;
  float blend_;                 // share of the effect, 0 .. 1; the rest is holes
  std::vector<double> depths_;  // of layers
  std::optional<PatternRays> pattern_;
  std::optional<ImageRays> image_;  // where there is no pattern
};

}  // namespace gpu_shading
