#pragma once

#include <ostream>
#include <string>

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading::energyplus {

// Writes a polar plot of a screen's transmittance as SVG: the radius is the angle of incidence, and
// colours are those of fraction_colour(), from 0 to the open fraction. Title and subtitle may be
// any text.
void write_polar_plot(PerforatedScreen const& screen, std::string const& title,
                      std::string const& subtitle, std::ostream& svg);

}  // namespace gpu_shading::energyplus
