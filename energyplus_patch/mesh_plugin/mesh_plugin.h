#pragma once

// The functions that libgpu_shading_meshes.so exports: Assimp behind a C interface, so that it and
// its dependencies are only loaded when a mesh is needed, and its zlib does not meet another one.
// No exception leaves these functions.

#include <cstddef>

inline constexpr char const* gpu_shading_mesh_library = "libgpu_shading_meshes.so";

extern "C" {

// The faces of one material in one node of the file.
struct gpu_shading_mesh {
  char const* name;  // name of the node, or of the mesh if the node has none
  char const* material;
  std::size_t vertices;
  double const* positions;  // x, y, z of each, after the transformations of the nodes
  float const* texture;     // u, v of each, v up; NULL: none
  std::size_t triangles;
  unsigned const* indices;  // three of each
};

struct gpu_shading_meshes {
  std::size_t count;
  gpu_shading_mesh const* meshes;
};

// Reads OBJ unchanged, and COLLADA and glTF with y up and in metres, whatever the file states.
// Polygons are converted to triangles; points and lines are left out. Returns 0 and meshes that
// must be freed, or 1 with the reason in `message`, one line.
int gpu_shading_read_meshes(char const* path, gpu_shading_meshes const** meshes, char* message,
                            std::size_t message_size);

void gpu_shading_free_meshes(gpu_shading_meshes const* meshes);
}
