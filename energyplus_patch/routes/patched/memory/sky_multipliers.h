#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// Finds EnergyPlus's anisotropic sky multipliers (SurfAnisoSkyMult), by surface from 1: the array
// of its SolarShadingData that `call`, its AnisoSkyViewFactors, computes from the ratios of the
// sky's shading; others that it sets do not depend on them, and those that it does not set keep
// what they had. nullptr if it is not found, as where the sun lights no surface yet. `symbols` must
// have those of Need::long_wave and Need::sky_patches.
std::byte* find_sky_multipliers(State& state, SymbolTable const& symbols,
                                std::function<void()> const& call);

// The elements of the array there; empty if it is not as expected.
std::span<double> sky_multipliers_at(std::byte const* array);

}  // namespace gpu_shading::energyplus
