#pragma once

#include <glm/vec2.hpp>

#include "filters/perforation/pattern_rays.h"
#include "filters/perforation/sheet_in_beam.h"

namespace gpu_shading {

// The effective transmittance, between the middles of a sheet's regions, of whole paths that pass
// the inside face at equal steps from `first`, m in the sheet's plane.
void find_by_region(SheetInBeam const& sheet, glm::dvec2 const& first, glm::dvec2 const& step,
                    PatternRays::Passed& passed);

}  // namespace gpu_shading
