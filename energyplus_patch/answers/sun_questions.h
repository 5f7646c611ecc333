#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "answers/cached_renderer.h"
#include "answers/predicted_directions.h"
#include "answers/sample_interpolation.h"

namespace gpu_shading::energyplus {

// Answers for the sun where EnergyPlus has set it: interpolated between samples where those are
// asked for and can answer, otherwise by CachedRenderer. Areas are in m2 normal to the beam.
// Functions throw gpu_shading::Error.
class SunQuestions {
 public:
  struct Site {
    std::vector<glm::dvec3> areas;  // of surfaces EnergyPlus may ask about: unit normal x m2
    std::optional<Sampling> sampling;
    PredictedDirections::Latitude latitude;  // none: not sampled, and no days are foreseen
  };

  explicit SunQuestions(Site site);
  ~SunQuestions() = default;
  SunQuestions(SunQuestions const&) = delete;  // samples refer to what is rendered
  SunQuestions& operator=(SunQuestions const&) = delete;

  // Answers from a scene from here on.
  void open(CachedRenderer rendered);
  // Forgets the scene and its answers. Questions need another open().
  void close();

  // CachedRenderer::deploy().
  void deploy(std::vector<double> const& shares, std::vector<double> const& positions) {
    rendered_->deploy(shares, positions);
  }
  void set_sun(SunDirection sun);

  // Where it is, as EnergyPlus passed it.
  glm::dvec3 const& towards_sun() const { return towards_sun_; }

  // Projected sunlit area of a receiver, with factors[schedule].
  double area(SurfaceId receiver, std::span<double const> factors);
  // Projected area of a surface that counts as unshaded.
  double unshaded_area(SurfaceId surface) const;
  // Areas that the sun lights of interior surfaces through a window, in order; 0 from a patch of
  // the sky (is_sky_patch).
  std::vector<float> interior_areas(InteriorKey const& key, std::span<double const> factors);

  CachedRenderer& rendered() { return *rendered_; }
  CachedRenderer const& rendered() const { return *rendered_; }
  std::optional<SampleInterpolation> const& sampled() const { return sampled_; }
  // Receivers that EnergyPlus asked about, by surface.
  std::vector<bool> const& asked() const { return asked_; }
  // Sums over all scenes that were open.
  CachedRenderer::Counts counts() const;
  AnswerErrors errors() const;

 private:
  AskedSun asked_sun() const;
  Sunlit const* find_sampled(SurfaceId receiver);
  double for_this_sun(SurfaceId surface) const;
  std::vector<float> sampled_interior_areas(InteriorKey const& key,
                                            std::span<double const> factors);

  Site site_;
  PredictedDirections predicted_;
  SunDirection sun_;  // by which answers are stored
  bool sky_ = false;  // it is a patch of the sky
  glm::dvec3 towards_kept_{0.0, 0.0, 1.0};
  glm::dvec3 towards_sun_{0.0, 0.0, 1.0};  // as EnergyPlus passes it
  std::optional<CachedRenderer> rendered_;
  std::optional<SampleInterpolation> sampled_;
  std::vector<bool> asked_;
  // Of scenes before this one.
  CachedRenderer::Counts earlier_;
  AnswerErrors earlier_errors_;
};

}  // namespace gpu_shading::energyplus
