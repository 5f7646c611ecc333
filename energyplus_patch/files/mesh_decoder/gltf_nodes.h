#pragma once

#include <filesystem>

namespace gpu_shading::decoding {

// Whether a file is a GLB by its first bytes.
bool is_glb(char const* path);

// Checks what Assimp takes on trust and follows without end: the lengths that a GLB states, and
// that the nodes of a glTF are trees, each node with one parent at most and not deeper than
// deepest_node. Throws std::runtime_error.
void check_gltf_nodes(char const* path);

}  // namespace gpu_shading::decoding
