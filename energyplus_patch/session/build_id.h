#pragma once

#include <cstddef>
#include <span>

namespace gpu_shading::energyplus {

// What the linker has named the library or program that this code is in after (--build-id): another
// one wherever a byte of its code or of its shaders is another. It is read from memory, so that a
// build that replaces the file while it runs does no harm. Throws Error where there is none.
std::span<std::byte const> build_id();

}  // namespace gpu_shading::energyplus
