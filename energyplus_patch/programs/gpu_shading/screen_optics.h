#pragma once

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading::energyplus {

// Fraction of the beam that passes a screen, away from its edges. Angles in degrees: theta, the
// angle of incidence from the normal, 0 to below 90, and phi, the azimuth about the normal from u
// towards v. Exact for patterns; for textures, from their table (see screen_transmittance.h).
double transmittance(PerforatedScreen const& screen, double theta, double phi);

}  // namespace gpu_shading::energyplus
