#pragma once

#include <vector>

#include "files/mesh_decoder/meshes.h"

struct aiScene;

// A scene as Assimp built it from a file, which may be wrong.

namespace gpu_shading::decoding {

// Whether a file is a GLB by its first bytes.
bool is_glb(char const* path);

// Checks what Assimp takes on trust and follows without end: the lengths that a GLB states, and
// that the nodes of a glTF are trees, each node with one parent at most and not deeper than
// max_depth. Throws std::runtime_error.
void check_gltf_nodes(char const* path);

// Before faces are cut into triangles. Throws std::exception if a face has more than max_corners
// or a vertex that does not exist.
void check_corners(aiScene const& scene);

// The triangles of a scene, as read_mesh_parts() gives them.
std::vector<MeshPart> parts_of(aiScene const& scene);

}  // namespace gpu_shading::decoding
