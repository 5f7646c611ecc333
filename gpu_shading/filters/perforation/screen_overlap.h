#pragma once

#include <span>

#include "filters/perforation/screens.h"
#include "view/view.h"

namespace gpu_shading {

// Whether some ray to a tile passes two of these screens. `view`: of the casters in front.
bool any_overlap(Screens const& screens, std::span<int const> numbers, View const& view);

}  // namespace gpu_shading
