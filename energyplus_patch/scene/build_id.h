#pragma once

#include <cstddef>
#include <span>

namespace gpu_shading::energyplus {

// The build ID that the linker has given to the library or program with this code (--build-id),
// which changes with any byte of its code or shaders. It is read from memory, so that a build that
// replaces the file during a run has no effect. Throws Error if there is none.
std::span<std::byte const> build_id();

}  // namespace gpu_shading::energyplus
