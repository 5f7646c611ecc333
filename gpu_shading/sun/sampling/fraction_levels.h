#pragma once

#include <span>
#include <vector>

namespace gpu_shading {

// The limits of a sunlit fraction and the values in between that many samples share, ascending.
//
// In the full shadow of a shade of constant transmittance, a fraction is exactly that
// transmittance, whatever the direction, like 0 in the shadow of an opaque caster. The part of a
// fraction between two levels next to one another varies between 0 and 1 of their distance, with
// kinks at both, and is interpolated by itself.
//
// The first level is the least of all samples where many share it, else 0; the last is 1. At most
// seven levels.
std::vector<double> fraction_levels(std::span<double const> fractions);

}  // namespace gpu_shading
