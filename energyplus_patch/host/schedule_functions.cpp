#include "host/schedule_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "binary/function_finder.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

ScheduleFunctions::ScheduleFunctions(SymbolTable const& symbols) {
  FunctionFinder finder(symbols);
  finder.find(
      "_ZN10EnergyPlus5Sched11GetScheduleERNS_14EnergyPlusDataERKNSt7__cxx1112basic_"
      "stringIcSt11char_traitsIcESaIcEEE",
      get_);
  finder.find("_ZN10EnergyPlus5Sched12ScheduleBase9getMinValERNS_14EnergyPlusDataE", minimum_);
  finder.find("_ZN10EnergyPlus5Sched12ScheduleBase9getMaxValERNS_14EnergyPlusDataE", maximum_);
  finder.find("_ZNK10EnergyPlus5Sched16ScheduleConstant10getHrTsValERNS_14EnergyPlusDataEii",
              constant_at_hour_);
  finder.find("_ZNK10EnergyPlus5Sched16ScheduleDetailed10getHrTsValERNS_14EnergyPlusDataEii",
              detailed_at_hour_);
  finder.check();
}

ScheduleFunctions::Schedule* ScheduleFunctions::find(State& state, std::string const& name) const {
  Schedule* const schedule = get_(state, name);
  if (schedule == nullptr) {
    throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", name));
  }
  return schedule;
}

double ScheduleFunctions::at_hour(Schedule const& schedule, State& state, int hour,
                                  int timestep) const {
  // getHrTsVal is virtual; its index in the virtual table is searched for, not assumed.
  constexpr int most_functions = 16;
  auto const* const functions = *reinterpret_cast<void* const* const*>(&schedule);
  for (int i = 0; i < most_functions; ++i) {
    for (auto* const candidate : {constant_at_hour_, detailed_at_hour_}) {
      if (functions[i] == reinterpret_cast<void*>(candidate)) {
        return candidate(&schedule, state, hour, timestep);
      }
    }
  }
  throw Error("EnergyPlus has a schedule of an unknown type");
}

Schedules ScheduleFunctions::of(State& state) const {
  auto const known = std::make_shared<std::unordered_map<std::string, Schedule*>>();
  auto const schedule = [this, &state, known](std::string const& name) -> Schedule& {
    auto const [place, added] = known->try_emplace(name, nullptr);
    if (added) place->second = find(state, name);
    return *place->second;
  };
  auto const limited = [](double value) { return std::clamp(value, 0.0, 1.0); };
  return {
      [this, &state, schedule, limited](std::string const& name) {
        auto& found = schedule(name);
        return std::pair(limited(minimum_(&found, state)), limited(maximum_(&found, state)));
      },
      [this, &state, schedule, limited](std::string const& name, Moment moment) {
        auto& found = schedule(name);
        return limited(moment.timestep > 0 ? at_hour(found, state, moment.hour, moment.timestep)
                                           : minimum_(&found, state));
      },
  };
}

}  // namespace gpu_shading::energyplus
