#pragma once

#include "gpu_shading/scene.h"

namespace gpu_shading {

// Leaves, triangles, angles of two pieces and crossing plates in front of a window (surface 0),
// some of them through its plane or on it, some of them cast only when turned away.
Scene mixed_crowd(int count);

// Every third caster counts.
ShadingRule thirds(Scene const& scene);

}  // namespace gpu_shading
