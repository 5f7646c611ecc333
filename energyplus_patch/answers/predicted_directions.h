#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "gpu_shading/sun_position.h"

namespace gpu_shading::energyplus {

// Predicts the directions that EnergyPlus will ask for next: it goes through all patches of the sky
// in a row, and through each day in equal steps of the hour angle at one declination. Predictions
// depend only on earlier questions, so equal runs make equal predictions. If fewer than half of the
// predictions come true, no further days are predicted.
class PredictedDirections {
 public:
  // Latitude of the site, radians; empty: no days are predicted.
  using Latitude = std::function<double()>;

  // Takes the direction `sun` that EnergyPlus asks for, in single precision. Returns the exact
  // direction of which it is a rounding: a patch of the sky or a predicted direction; otherwise
  // `sun` itself.
  SunDirection snap_to_known(SunDirection sun, Latitude const& latitude);

  // The directions predicted to follow the last one, in order. Valid until the next call of
  // snap_to_known().
  std::span<SunDirection const> ahead() const { return ahead_; }

 private:
  struct Day {
    HourDirection first;
    double step = 0.0;  // of the hour angle
    std::vector<SunDirection> directions;
  };

  // That direction and those after it on the day of which it is one; empty if there is none.
  std::span<SunDirection const> find(SunDirection sun, double latitude) const;
  bool predictions_fail() const;
  void predict_day(SunDirection sun, double latitude);
  void learn_step(HourDirection now, double latitude);

  std::multimap<double, Day> by_declination_;
  std::span<SunDirection const> ahead_;
  std::optional<SunDirection> last_;  // of a day
  std::optional<double> step_;        // step of the hour angle, radians
  std::size_t predicted_ = 0;         // directions of days
  std::size_t met_ = 0;               // number of these that had been predicted
};

}  // namespace gpu_shading::energyplus
