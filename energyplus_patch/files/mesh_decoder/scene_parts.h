#pragma once

#include <vector>

#include "files/mesh_decoder/meshes.h"

struct aiScene;

// A scene as Assimp built it from a file, which may be wrong.
namespace gpu_shading::decoding {

// Before faces are cut into triangles. Throws std::exception if a face has more than most_corners
// or a vertex that does not exist.
void check_corners(aiScene const& scene);

// The triangles of a scene, as read_mesh_parts() gives them.
std::vector<MeshPart> parts_of(aiScene const& scene);

}  // namespace gpu_shading::decoding
