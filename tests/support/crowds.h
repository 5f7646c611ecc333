#pragma once

#include "gpu_shading/scene.h"

namespace gpu_shading {

// Leaves, triangles, angles of two pieces and crossing plates in front of a window (surface 0),
// some of them through its plane or on it, some of them cast only when turned away.
Scene mixed_crowd(int count);

// Louvres all over a window of 3 m x 2 m (surface 0), 1 / count m deep and twice that apart, that
// reach beyond it on both sides by so many metres.
Scene fine_louvres(int count, double beyond);

// A window of 3 m x 2 m (surface 0) behind so many pieces of 20 louvres, in coordinates that are
// rounded to 1e-5 m, as the example's box with louvres has them.
Scene pieces_of_louvres(int count);

// Every third caster counts.
ShadingRule thirds(Scene const& scene);

}  // namespace gpu_shading
