#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "answers/cached_renderer.h"
#include "gpu_shading/sampled_sunlit.h"

namespace gpu_shading::energyplus {

// Answers at the sun's positions from samples (--gpu-shading-update sampled:...), by the state of
// the screens' deployments and of the moving shades' positions.
class SampleInterpolation {
 public:
  // What is sampled comes from `rendered`, which has to outlive this.
  SampleInterpolation(Sampling sampling, CachedRenderer& rendered)
      : sampling_(sampling), rendered_(&rendered) {}

  struct Question {
    SunDirection sun;
    double latitude;  // of the site, radians
  };

  // nullptr where the answer has to be rendered: for patches of the sky, for directions that the
  // sun never has, for receivers that the sun faces at no sample, and for a state that few
  // directions are asked of. The first direction has the samples taken, of all receivers so far;
  // others that turn up later have theirs taken together. Valid until the next call.
  Sunlit const* find(SurfaceId receiver, Question const& question);

  // The same of interior surfaces that the sun reaches through a window, sampled at the window's
  // directions: their areas in the order of the question's list. nullptr where find() has not
  // answered for the window at this sun and state.
  std::vector<Sunlit> const* find_interior(InteriorKey const& key, SunDirection sun);

  // Directions that samples were taken at, those of each state and of later receivers apart.
  std::size_t sampled() const { return sampled_; }
  // Largest estimated mean error of a receiver's sunlit fraction.
  double expected_error() const { return expected_error_; }
  // Directions answered from samples.
  std::size_t answered() const { return answered_; }

 private:
  struct BatchRow {
    std::size_t batch;
    std::size_t row;
  };
  struct Interior {
    SampledSunlit samples;
    std::optional<SunDirection> sun;  // of the row
    std::vector<Sunlit> row;
  };
  struct State {
    std::vector<SampledSunlit> batches;
    std::unordered_map<SurfaceId, BatchRow> places;
    std::optional<SunDirection> sun;  // of the rows
    std::vector<std::vector<Sunlit>> rows;
    std::unordered_map<std::uint64_t, Interior> interiors;  // by InteriorKey::hash
    std::size_t rendered = 0;  // directions, before it is worth samples
    std::optional<SunDirection> last_rendered = std::nullopt;
  };

  void sample(State& state, std::vector<SurfaceId> receivers);
  bool worth_samples(State& state, SunDirection sun);

  Sampling sampling_;
  CachedRenderer* rendered_;
  double latitude_ = 0.0;
  std::map<std::uint32_t, State> states_;
  std::size_t sampled_ = 0;
  double expected_error_ = 0.0;
  std::size_t answered_ = 0;
};

}  // namespace gpu_shading::energyplus
