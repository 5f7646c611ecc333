#pragma once

#include <cstddef>
#include <vector>

#include "solar/sun_arcs.h"
#include "solar/sunlit_table.h"

namespace gpu_shading {

// By receiver and sampled direction: how far a receiver's other samples miss its fraction, 0 where
// the sun does not face it.
using Misses = std::vector<std::vector<double>>;

// `count` further directions: each time the candidate where misses of the samples near it, summed
// over the receivers that the sun faces there, times the square of its distance to the nearest
// direction are largest. Counted by how long the sun is at a declination, too.
std::vector<HourDirection> where_samples_disagree(SunlitTable const& table, Misses const& misses,
                                                  double latitude, std::size_t count);

}  // namespace gpu_shading
