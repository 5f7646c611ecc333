#pragma once

#include <string>

#include "routes/patched/binary/symbol_table.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// Where EnergyPlus keeps the current value of a Schedule:Constant, whose value it takes from there
// at each timestep; nullptr if there is no such schedule, or if that is not found. `symbols` must
// have those of Need::constants and Need::from_25_1.
double* find_constant_schedule(State& state, SymbolTable const& symbols, std::string const& name);

}  // namespace gpu_shading::energyplus
