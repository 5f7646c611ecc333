#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "gpu_shading/perforated_screen.h"

// The files of `gpu_shading screen`.
namespace gpu_shading::energyplus {

// Fraction of the beam that passes a screen, away from its edges. Angles in degrees: theta, the
// angle of incidence from the normal, 0 to below 90, and phi, the azimuth about the normal from u
// towards v. Exact for patterns; for textures, from their table (see screen_transmittance.h).
double transmittance(PerforatedScreen const& screen, double theta, double phi);

// A table by whole degrees of theta and every 5 degrees of phi.
void write_transmittances(PerforatedScreen const& screen, std::ostream& csv);

// Writes a polar plot of a screen's transmittance as SVG: the radius is the angle of incidence, and
// colours are those of fraction_colour(), from 0 to the open fraction. Title and subtitle may be
// any text.
void write_polar_plot(PerforatedScreen const& screen, std::string const& title,
                      std::string const& subtitle, std::ostream& svg);

// Encodes a picture of one tile of a screen, from the front and from the right at an angle: the
// face grey, the walls of holes dark, and what lies behind light. A pattern's tile has a hole at
// its centre. Nothing, with a warning, in installations without the picture formats.
std::optional<std::string> encode_tile(PerforatedScreen const& screen, std::string const& name);

// Diffuse reflectances of the solid part of a sheet, 0 .. 1; both faces are alike.
struct SheetReflectance {
  double solar = 0.0;
  double visible = 0.0;

  bool operator==(SheetReflectance const&) const = default;
};

// Writes a screen as a bidirectional scattering distribution in LBNL WINDOW's XML: Klems's full
// basis of 145 x 145 directions, Solar and Visible, Transmission and Reflection, Front and Back
// (front: outside), in 1/sr.
// - Transmission is that of the undeviated beam. A patch of directions has the mean of tau
//   over its projected solid angle, on the diagonal, because a beam that goes on has the same patch
//   on both sides.
// - Reflection is that of the solid share of the faces, reflectance x (1 - open fraction) / pi for
//   all pairs of directions: the faces are level and matt, and holes return nothing.
// Light that the walls of holes reflect is not included.
//
// Axes: v is up, and the azimuths of patches run from the right to up as seen from inside: (theta,
// phi) has the azimuth pi - phi. `rotation`: from the lower edge of the surface to u, degrees
// counterclockwise as seen from outside. `name` and `description` may be any text.
//
// Basis and format: Klems & Warner, "Measurement of bidirectional optical properties of complex
// shading devices" (ASHRAE Transactions 101, 1995); WINDOW's BSDF-v1.7.xsd.
void write_bsdf(PerforatedScreen const& screen, double rotation,
                SheetReflectance const& reflectance, std::string const& name,
                std::string const& description, std::ostream& xml);

}  // namespace gpu_shading::energyplus
