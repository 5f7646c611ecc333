#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "gpu_shading/sun_position.h"

namespace gpu_shading::energyplus {

// The directions that EnergyPlus will ask for after those it has asked for: it goes through all
// patches of the sky in a row, and through each day by equal steps of the hour angle at one
// declination. What is foreseen depends on what was asked alone, so that the same run foresees the
// same. Where less than half of what was foreseen came true, no further days are.
class ForeseenDirections {
 public:
  // Of the site, radians; none: no days are foreseen.
  using Latitude = std::function<double()>;

  // EnergyPlus asks for `sun`, in single precision. Returns what it is a rounding of: a patch of
  // the sky, or the direction that was foreseen for it; itself where none was.
  SunDirection settle(SunDirection sun, Latitude const& latitude);

  // Those to follow the one settled last, in their order. Valid until the next call of settle().
  std::span<SunDirection const> ahead() const { return ahead_; }

 private:
  using Day = std::vector<SunDirection>;
  struct Place {
    std::size_t day;
    std::size_t step;
  };

  std::optional<Place> find(SunDirection sun) const;
  bool in_vain() const;
  void foresee_day(SunDirection sun, double latitude);
  void learn_step(HourDirection now, double latitude);

  std::deque<Day> days_;
  std::multimap<double, Place> by_altitude_;
  std::span<SunDirection const> ahead_;
  std::optional<SunDirection> last_;  // of a day
  std::optional<double> step_;        // of the hour angle, radians
  std::size_t foreseen_ = 0;          // directions of days
  std::size_t met_ = 0;               // of those asked for, how often one had been foreseen
};

// Whether EnergyPlus takes the direction for a patch of the sky: 7.5 degrees of altitude and steps
// of 15 from there, multiples of 15 degrees of azimuth. That the sun stands there exactly is as
// good as impossible, and does no harm.
bool is_sky_patch(SunDirection sun);

}  // namespace gpu_shading::energyplus
