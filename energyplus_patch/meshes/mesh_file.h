#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

struct Mesh {
  std::string name;
  std::string material;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> texture;  // u and v of each position, v upwards; or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Whether a format states its unit and what is up (COLLADA, glTF), so that read_meshes gives metres
// with y up; OBJ does not. By the name's ending; throws Error where that is none of them.
bool states_its_axes(std::filesystem::path const& path);

// Reads OBJ, COLLADA (.dae) or glTF (.gltf, .glb) by Assimp. Coordinates come in single precision.
// Throws Error: "FILE: why", one line.
std::vector<Mesh> read_meshes(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
