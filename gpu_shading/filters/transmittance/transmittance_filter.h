#pragma once

#include "gpu_shading/beam_filter.h"

namespace gpu_shading {

double factor_at(AngularTransmittance const& kind, double cosine);
void add_values(FilterDigest& digest, AngularTransmittance const& kind);

}  // namespace gpu_shading
