#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "model/input/moving_shades.h"

namespace gpu_shading::energyplus {

// Positions of all moving shades on their step grids, and the weight of the answers there.
struct WeightedPositions {
  std::vector<double> positions;
  double weight = 1.0;
};

// A value that lies a share of the way, 0 .. 1, from that of a corner to the next on its grid.
struct BetweenSteps {
  double share;
  std::size_t place;  // among the corner's positions
  double next;
};

// The simplex around a point, to interpolate linearly: `first`, and one corner more for each value
// between steps.
std::vector<WeightedPositions> simplex_from(std::vector<double> first,
                                            std::vector<BetweenSteps> between);

// Positions on the grids to interpolate linearly between for `exact`, by the simplex around it (one
// more than the shades between steps). The first is `stood`, the nearest on the grids. Only this
// one if all shades stand exactly there.
std::vector<WeightedPositions> around(std::vector<MovingShade> const& shades,
                                      std::vector<double> const& stood,
                                      std::vector<double> const& exact);

// Measures the error of interpolating between positions at some timesteps of a run.
class StepError {
 public:
  // A timestep: what was interpolated between, and for which positions.
  void note(SunDirection sun, std::vector<WeightedPositions> const& corners,
            std::vector<double> const& exact);

  // Sunlit fractions of the same receivers, in order.
  using Fractions =
      std::function<std::vector<double>(SunDirection sun, std::vector<double> const& positions)>;
  struct Estimate {
    double mean = 0.0;  // of the timesteps' errors, each of the receiver most affected
    double most = 0.0;
    std::size_t timesteps = 0;
  };
  // None: nothing was interpolated.
  std::optional<Estimate> estimate(Fractions const& fractions) const;

 private:
  struct Sample {
    SunDirection sun;
    std::vector<WeightedPositions> corners;
    std::vector<double> exact;
  };

  std::vector<Sample> samples_;
  std::size_t stride_ = 1;  // of timesteps from one sample to the next
  std::size_t noted_ = 0;
};

}  // namespace gpu_shading::energyplus
