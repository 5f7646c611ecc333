#pragma once

#include <optional>

#include "calculation/session.h"
#include "routes/patched/binary/stored_result.h"
#include "routes/patched/symbols/energyplus_types.h"

namespace gpu_shading::energyplus {

// EnergyPlus creates a mirrored copy of every shading surface for the sun on its other side. With
// pixel counting, it does not pass these copies on and takes their sunlit fraction as 0, so that
// what the back of a shading surface reflects is lost (EnergyPlus issue 10366). This function adds
// the copies to the session and writes their ids to EnergyPlus's array of surface ids, so that it
// asks about them too. `ids`: the path to that array from the state. Returns the number of copies,
// or nothing if the array does not have the expected contents.
std::optional<std::size_t> hand_over_mirrored_surfaces(State& state, Session& session,
                                                       StoredResult const& ids);

}  // namespace gpu_shading::energyplus
