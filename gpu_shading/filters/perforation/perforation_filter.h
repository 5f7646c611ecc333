#pragma once

#include "gpu_shading/beam_filter.h"

namespace gpu_shading {

BeamFilter::Faces faces_of(PerforatedSheet const& kind);
FilterLook look_of(PerforatedSheet const& kind);
void add_values(FilterDigest& digest, PerforatedSheet const& kind);

}  // namespace gpu_shading
