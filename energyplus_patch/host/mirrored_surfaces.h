#pragma once

#include <optional>

#include "binary/stored_result.h"
#include "host/energyplus.h"
#include "session/session.h"

namespace gpu_shading::energyplus {

// EnergyPlus makes a mirrored copy of every shading surface for the sun on its other side, but does
// not hand it over, and with pixel counting takes its sunlit fraction as 0: what the back of a
// shading surface reflects is lost (EnergyPlus issue 10366). This adds the copies to the session
// and writes their ids to where EnergyPlus keeps the ids of all surfaces, so that it asks for them
// too. `ids`: the path to that array from the state. Returns the number of copies; nothing where
// the array does not hold what it must.
std::optional<std::size_t> hand_over_mirrored_surfaces(State& state, Session& session,
                                                       StoredResult const& ids);

}  // namespace gpu_shading::energyplus
