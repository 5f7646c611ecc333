#pragma once

#include "gpu_shading/beam_filter.h"

namespace gpu_shading {

BeamFilter::Faces faces_of(Crown const& kind);
FilterLook look_of(Crown const& kind);
void add_values(FilterDigest& digest, Crown const& kind);

}  // namespace gpu_shading
