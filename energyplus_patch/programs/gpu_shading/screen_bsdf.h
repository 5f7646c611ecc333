#pragma once

#include <ostream>
#include <string>

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading::energyplus {

// What the solid part of a sheet's faces reflects, diffusely, 0 .. 1; both faces are alike.
struct SheetReflectance {
  double solar = 0.0;
  double visible = 0.0;

  bool operator==(SheetReflectance const&) const = default;
};

// Writes a screen as a bidirectional scattering distribution in LBNL WINDOW's XML: Klems's full
// basis of 145 x 145 directions, Solar and Visible, Transmission and Reflection, Front and Back
// (front: outside), in 1/sr.
// - Transmission is what passes of the beam, straight on. A patch of directions has the mean of tau
//   over its projected solid angle, on the diagonal, because a beam that goes on has the same patch
//   on both sides.
// - Reflection is that of the solid share of the faces, reflectance x (1 - open fraction) / pi for
//   all pairs of directions: the faces are level and matt, and holes return nothing.
// Light that the walls of holes reflect is not in it.
//
// Axes: v is up, and the azimuths of patches run from the right to up as seen from inside, so that
// of (theta, phi) is pi - phi. `rotation`: of u and v from the lower edge of the surface,
// counterclockwise as seen from outside, degrees. `name` and `description` may be any text.
//
// Basis and format: Klems & Warner, "Measurement of bidirectional optical properties of complex
// shading devices" (ASHRAE Transactions 101, 1995); WINDOW's BSDF-v1.7.xsd.
void write_bsdf(PerforatedScreen const& screen, double rotation,
                SheetReflectance const& reflectance, std::string const& name,
                std::string const& description, std::ostream& xml);

}  // namespace gpu_shading::energyplus
