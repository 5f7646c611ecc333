#pragma once

#include <cstddef>
#include <vector>

#include "solar/sun_arcs.h"
#include "solar/sunlit_table.h"

namespace gpu_shading {

// By receiver and sampled direction: the error of predicting a receiver's fraction from its other
// samples; 0 if the sun does not face it.
using Misses = std::vector<std::vector<double>>;

// Returns `count` further directions. Each is the candidate with the largest product of the errors
// of nearby samples, summed over the receivers that the sun faces there, and the square of its
// distance to the nearest direction, weighted by how long the sun is at that declination.
std::vector<HourDirection> where_samples_disagree(SunlitTable const& table, Misses const& misses,
                                                  double latitude, std::size_t count);

}  // namespace gpu_shading
