#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gpu_shading::decoding {

// The faces of one material in one node of the file.
struct MeshPart {
  std::string name;  // of the node, or of the mesh if the node has none
  std::string material;
  std::vector<double> positions;       // x, y, z of each vertex, the nodes' transformations applied
  std::vector<float> texture;          // u, v of each, v up; or empty
  std::vector<std::uint32_t> indices;  // three of each triangle
};

struct MeshFile {
  char const* path;  // what is opened
  std::filesystem::path
      name;          // what the user calls it; files that it names are looked for beside it
  bool any = false;  // in any format, with files anywhere
};

// Of all parts of a file together. A file with more is refused.
inline constexpr std::size_t max_vertices = 20'000'000;
inline constexpr std::size_t max_triangles = 20'000'000;
inline constexpr std::size_t max_parts = 1'000'000;
// Of one face: the time to cut it into triangles grows with the cube of that.
inline constexpr unsigned max_corners = 1000;
inline constexpr std::size_t max_depth = 1000;

// Reads OBJ and other formats that state no axes unchanged, and COLLADA and glTF with y up and in
// metres, whatever the file states. Polygons are converted to triangles; points and lines are left
// out. Throws std::exception.
std::vector<MeshPart> read_mesh_parts(MeshFile const& file);

}  // namespace gpu_shading::decoding
