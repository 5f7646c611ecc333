#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calculation/session.h"
#include "routes/patched/symbols/energyplus_symbols.h"

// EnergyPlus's array of surface ids: by the number of a surface, what add_surface returned for it,
// or -1 if the surface was not handed over. EnergyPlus counts surfaces from 1.
namespace gpu_shading::energyplus {

// Where a function stores the results of another in an array, as a path of pointers from an object
// that it holds in a register: element i is at  *(*(object + outer) + inner) + 4 i.
struct StoredResult {
  std::int64_t outer = 0;
  std::int64_t inner = 0;
};

// Reads the path from the code of `caller`, which stores the 32-bit result of its last call of
// `callee`. Empty if the code does not have this form.
std::optional<StoredResult> find_stored_result(Symbol const& caller, Symbol const& callee);

// The path from the state to the array, found in the code of EnergyPlus's function that fills it.
// Empty if that does not have the expected form. Must come before the code is patched.
std::optional<StoredResult> find_surface_ids(SymbolTable const& symbols);

// The ids of all surfaces, by number; the first element stands for no surface. `surfaces`: how many
// EnergyPlus has. Throws Unexpected.
std::vector<std::optional<SurfaceId>> read_surface_ids(State& state, StoredResult const& path,
                                                       std::int32_t surfaces,
                                                       Session const& session);

// EnergyPlus creates a mirrored copy of every shading surface for the sun on its other side. With
// pixel counting, it does not pass these copies on and takes their sunlit fraction as 0, so that
// what the back of a shading surface reflects is lost (EnergyPlus issue 10366). This function adds
// the copies to the session and writes their ids to the array, so that EnergyPlus asks about them
// too. Returns the number of copies, or nothing if the array does not have the expected contents.
std::optional<std::size_t> hand_over_mirrored_surfaces(State& state, Session& session,
                                                       StoredResult const& path);

}  // namespace gpu_shading::energyplus
