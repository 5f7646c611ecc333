#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "filters/perforation/image_rays.h"
#include "filters/perforation/pattern_rays.h"
#include "filters/perforation/row_profile.h"
#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {

// Transmittance of a screen at one sun direction, ray by ray on the CPU, by the same rule as
// screen.frag, which explains the terms.
class SheetRays {
 public:
  // `sheet` must not be solid. `pixel`: the size of pixels in the sheet's plane, m. `by_rows`:
  // where pixels are too large for holes, by rows of them, if there is a pattern and its effective
  // transmittance was not asked for. All must outlive it.
  SheetRays(PerforatedScreen const& screen, SheetInBeam const& sheet, double pixel, bool by_rows);

  // The transmittance of the whole path, if it is the same everywhere.
  std::optional<float> everywhere() const;

  // The transmittances of the whole path for rays that pass the inside face at `first` and at equal
  // steps from there, m in the sheet's plane; only for those whose bit is set in `wanted`, lowest
  // bit first.
  static constexpr int max_rays = PatternRays::most;
  using Passed = PatternRays::Passed;
  void whole_paths(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                   Passed& passed) const;

  // Whether a ray passes or not, and nothing between.
  bool all_or_nothing() const { return has_edges(sheet_) && blend_ == 0.0F; }
  // The same as `whole_paths`, if so: a bit for each ray.
  std::uint64_t passing(glm::dvec2 const& first, glm::dvec2 const& step,
                        std::uint64_t wanted) const {
    return image_ ? image_->passing(first, step, wanted) : pattern_->passing(first, step, ray_);
  }

  // The transmittance of a part of the path, 0 at the inside face and 1 at the outside face.
  float part_of_path(glm::dvec2 const& place, double begin, double end) const;

 private:
  bool is_whole(double begin, double end) const { return begin <= 0.0 && end >= 1.0; }
  float solid_at(glm::dvec2 const& place) const;
  float through_layers(glm::dvec2 const& place, double begin, double end) const;
  float through_holes(glm::dvec2 const& place, double begin, double end) const;
  // Of whole paths, as `whole_paths`.
  void find_through_holes(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                          Passed& passed) const;
  void find_by_effect(glm::dvec2 const& first, glm::dvec2 const& step, Passed& passed) const;
  float through_effective(glm::dvec2 const& place, double begin, double end) const;

  SheetInBeam const& sheet_;
  glm::dvec2 ray_;
  glm::dvec2 tile_;
  float blend_;                 // weight of the effective transmittance, 0 .. 1; the rest is holes
  std::vector<double> depths_;  // of layers
  std::optional<PatternRays> pattern_;
  std::optional<RowProfile> rows_;  // if wanted
  std::optional<ImageRays> image_;  // where there is no pattern
};

// A ray that meets a sheet anywhere in the scene.
struct SheetRay {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0};  // of unit length
  double length = 0.0;
  double limit = 0.0;   // it meets nothing farther away
  double margin = 0.0;  // from a sheet's plane, within which neither of its ends meets it, m
};

struct MetSheet {
  double distance;  // of the polygon, or else of the middle of the body
  double passed;    // 0 .. 1, of a sheet that is fully deployed
};

// By its holes, or by its effective transmittance, whose table is computed at the first call.
std::optional<MetSheet> meet_sheet(Screens::Entry const& entry, SheetRay const& ray, bool by_holes);

}  // namespace gpu_shading
