#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "model/input/moving_shades.h"

namespace gpu_shading::energyplus {

// Estimates what it changes that moving shades stand at steps, not exactly where they should. At
// some timesteps of a run, sunlit fractions are taken to be linear between the step at which the
// shades stood and the next one on the other side of where they should have stood.
class StepError {
 public:
  // Refers to the shades.
  explicit StepError(std::vector<MovingShade> const& shades) : shades_(shades) {}

  // A timestep: positions, and those before they were rounded. Timesteps at which nothing was
  // rounded do not count.
  void note(SunDirection sun, std::vector<double> const& stood, std::vector<double> const& exact);

  // Sunlit fractions of the same receivers, in order.
  using Fractions =
      std::function<std::vector<double>(SunDirection sun, std::vector<double> const& positions)>;
  struct Estimate {
    double mean = 0.0;  // of the timesteps' errors, each of the receiver most affected
    double most = 0.0;
    std::size_t timesteps = 0;
  };
  // None: nothing was rounded.
  std::optional<Estimate> estimate(Fractions const& fractions) const;

 private:
  struct Sample {
    SunDirection sun;
    std::vector<double> stood;
    std::vector<double> beyond;
    double share = 0.0;  // of the way from the one to the other
  };

  std::vector<MovingShade> const& shades_;
  std::vector<Sample> samples_;
  std::size_t stride_ = 1;  // of timesteps from one sample to the next
  std::size_t noted_ = 0;
};

}  // namespace gpu_shading::energyplus
