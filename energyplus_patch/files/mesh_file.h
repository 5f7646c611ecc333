#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "files/asset_folder.h"

namespace gpu_shading::energyplus {

struct Mesh {
  std::string name;
  std::string material;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> texture;  // u and v of each position, v up; or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Whether a format states its unit and up axis (COLLADA, glTF), so that read_meshes returns metres
// with y up; OBJ does not. By the ending of the file's name; throws Error if it is none of these
// and `assets` does not permit others, which are taken to state nothing.
bool states_its_axes(std::filesystem::path const& path, Assets assets = Assets::restricted);

// Begins to decode a file, in another process, and returns what reads its meshes: once. Both throw
// what read_meshes() throws.
using MeshReading = std::function<std::vector<Mesh>()>;
MeshReading begin_reading_meshes(std::filesystem::path const& path, Assets assets);

// Reads OBJ, COLLADA (.dae) or glTF (.gltf, .glb), or whatever `assets` permits. Coordinates have
// single precision. Throws Error: "FILE: why", one line.
std::vector<Mesh> read_meshes(std::filesystem::path const& path,
                              Assets assets = Assets::restricted);

}  // namespace gpu_shading::energyplus
