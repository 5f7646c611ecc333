#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "routes/hosted_run.h"
#include "runs/schedule_days.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// What OpenGL does not tell: the time that a direction to the sun stands for, and the schedules at
// that time. EnergyPlus computes shading for a day, or for several days with the mean of their
// equations of time and one day's schedules; the hour follows from the direction.
class ScheduleClock {
 public:
  using Today = std::function<std::optional<HostedDay>()>;

  // `update_days`: how many days one calculation is for. `today`: the day that EnergyPlus is at.
  ScheduleClock(ScheduleDays days, int update_days, Today today);

  // Nothing where EnergyPlus is at no day that is known.
  std::optional<Moment> moment_of(glm::dvec3 const& towards_sun) const;

  // As Schedules has them. Throws Error for a schedule that EnergyPlus does not know.
  std::pair<double, double> range(std::string const& schedule) const;
  double value(std::string const& schedule, Moment moment) const;

 private:
  using Date = std::pair<int, int>;  // month and day

  ScheduleDay const* find(HostedDay const& today) const;
  std::size_t number_of(std::string const& schedule) const;

  ScheduleDays days_;
  int update_days_;
  Today today_;
  std::multimap<Date, std::size_t> by_date_;
};

}  // namespace gpu_shading::energyplus
