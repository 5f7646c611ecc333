#pragma once

#include <string>
#include <unordered_map>
#include <utility>

#include "binary/symbol_table.h"
#include "host/energyplus.h"
#include "session/schedules.h"

namespace gpu_shading::energyplus {

// The functions of EnergyPlus that read its schedules, looked up by name.
class ScheduleFunctions {
 public:
  ScheduleFunctions() = default;
  // Throws Error with the list of functions that the build lacks.
  explicit ScheduleFunctions(SymbolTable const& symbols);

  // A run's schedules by upper-case name; values are limited to 0 .. 1. Functions throw Error if
  // EnergyPlus has no such schedule.
  Schedules of(State& state) const;

 private:
  struct Schedule;  // EnergyPlus's own
  using Get = Schedule*(State&, std::string const&);
  using Extreme = double(Schedule*, State&);
  using AtHour = double(Schedule const*, State&, int hour, int timestep);

  Schedule* find(State& state, std::string const& name) const;
  double at_hour(Schedule const& schedule, State& state, int hour, int timestep) const;

  Get* get_ = nullptr;
  Extreme* minimum_ = nullptr;
  Extreme* maximum_ = nullptr;
  AtHour* constant_at_hour_ = nullptr;
  AtHour* detailed_at_hour_ = nullptr;
};

}  // namespace gpu_shading::energyplus
