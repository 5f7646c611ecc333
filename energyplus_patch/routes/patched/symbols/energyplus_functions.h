#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/sun_position.h"
#include "reports/run_record.h"
#include "routes/patched/binary/symbol_table.h"
#include "routes/patched/symbols/energyplus_symbols.h"
#include "scene/perez_sky.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// The functions of EnergyPlus that we call, looked up by name.
class EnergyPlusFunctions {
 public:
  EnergyPlusFunctions() = default;
  // `symbols` must have those of Need::run, and of Need::from_25_1 or Need::before_25_1.
  explicit EnergyPlusFunctions(SymbolTable symbols) : symbols_(std::move(symbols)) {}

  // Ends the run as EnergyPlus does: a fatal message, then its own exception.
  [[noreturn]] void fatal(State& state, std::string const& message) const;
  void warning(State& state, std::string const& message) const;
  void text(State& state, std::string const& message) const;

  // Latitude of the site in radians, as in EnergyPlus: from the weather file, or from Site:Location
  // without one.
  double latitude(State const& state) const;

  // The day that EnergyPlus is at, without its beam. For Need::run_days.
  RunDay day(State& state) const;
  // The beam of that day (RunDay::beam). For Need::run_days.
  std::vector<double> beam_of_day(State& state) const;
  // The wind speed of that day, m/s, likewise.
  std::vector<double> wind_of_day(State& state) const;

  // The timestep that EnergyPlus is at. For Need::run_days.
  Moment moment(State& state) const;

  // The sun and the weather of the timestep that EnergyPlus is at; the sun may be below the
  // horizon. For Need::run_days.
  SkyWeather sky_weather(State& state) const;

  // Adds an output variable of zone timesteps, averaged over longer times, in "deg", "m", "W/m2" or
  // "" (no unit); `value` must outlive the run. For Need::outputs.
  void add_output(State& state, std::string const& name, std::string_view unit,
                  std::string const& object, double& value) const;

  // Whether the sun is up in the weather of the timestep that EnergyPlus is at. For
  // Need::daylight_memory.
  bool sun_in_weather(State& state) const { return symbol::sun_is_up.in(symbols_)(&state) != 0; }

  // Calls `function` at the end of each zone timestep. Before the simulation begins. For
  // Need::reflected_light, as are the functions below.
  void at_end_of_timesteps(State& state, void (*function)(State*)) const;
  // In that: the numbers of a surface's variables, and what they say; all 0 if EnergyPlus has none.
  using Irradiances = std::array<int, 4>;
  Irradiances irradiances_of(State& state, std::string const& surface) const;
  DiffuseLight diffuse_light(State& state, Irradiances const& numbers) const;
  // Before the simulation begins: that the next is wanted.
  void request_light_of_ground(State& state) const;
  // The number of a variable, what level ground in the open reflects, W/m2; Error if EnergyPlus has
  // none. Finding it takes time.
  int light_of_ground(State& state) const;
  double variable(State& state, int number) const;

  SymbolTable const& symbols() const { return symbols_; }

 private:
  // Direction cosines of the sun: east, north, up.
  Vector sun(State const& state, double hour, double equation_of_time, double sine_of_declination,
             double cosine_of_declination) const;
  // The same at a time in hours of a day.
  Vector sun(State const& state, SunOfTime const& day, double hour) const;
  // The values at the timesteps of a day: value_at(hour from 0, timestep from 1, when the sun is
  // taken, in hours).
  template <typename ValueAt>
  std::vector<double> of_day(State& state, ValueAt value_at) const;

  SymbolTable symbols_;
};

// How a release of EnergyPlus keeps schedules.
class ScheduleInterface;

// The functions of EnergyPlus that read its schedules, looked up by name.
class ScheduleFunctions {
 public:
  ScheduleFunctions() = default;
  // `symbols` must have those of Need::from_25_1 or Need::before_25_1. Throws Error if schedules
  // are objects of an unknown kind.
  explicit ScheduleFunctions(SymbolTable const& symbols);

  // A run's schedules by upper-case name; values are limited to 0 .. 1. Functions throw Error if
  // EnergyPlus has no such schedule.
  Schedules of(State& state) const;

 private:
  std::shared_ptr<ScheduleInterface const> interface_;
};

}  // namespace gpu_shading::energyplus
