#pragma once

#include <ostream>
#include <string>

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading::energyplus {

// Writes what a screen lets pass of the beam, straight on, as a bidirectional scattering
// distribution in LBNL WINDOW's XML: Klems's full basis of 145 x 145 directions, Solar and Visible,
// Transmission Front and Back (front: outside). A patch of directions has the mean of tau over its
// projected solid angle, on the diagonal, because a beam that goes on has the same patch on both
// sides. What the sheet reflects, and light that the walls of holes reflect, is not in it.
//
// Axes: v is up, and the azimuths of patches run from the right to up as seen from inside, so that
// of (theta, phi) is pi - phi. `rotation`: of u and v from the lower edge of the surface,
// counterclockwise as seen from outside, degrees. `name` and `description` may be any text.
//
// Basis and format: Klems & Warner, "Measurement of bidirectional optical properties of complex
// shading devices" (ASHRAE Transactions 101, 1995); WINDOW's BSDF-v1.7.xsd.
void write_bsdf(PerforatedScreen const& screen, double rotation, std::string const& name,
                std::string const& description, std::ostream& xml);

}  // namespace gpu_shading::energyplus
