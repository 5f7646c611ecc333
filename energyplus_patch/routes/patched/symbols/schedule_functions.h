#pragma once

#include <memory>

#include "routes/patched/binary/symbol_table.h"
#include "routes/patched/symbols/energyplus_types.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

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
