#pragma once

// What libgpu_shading_meshes.so exports: Assimp behind a C interface, so that it and what it needs
// are loaded only when a mesh is wanted, and its zlib meets no other. No exception leaves these
// functions.

#include <cstddef>

inline constexpr char const* gpu_shading_mesh_library = "libgpu_shading_meshes.so";

extern "C" {

// What one node of the file has of one material.
struct gpu_shading_mesh {
  char const* name;  // of the node, else of the mesh
  char const* material;
  std::size_t vertices;
  double const* positions;  // x, y, z of each, where the nodes put them
  float const* texture;     // u, v of each, v upwards; NULL: it has none
  std::size_t triangles;
  unsigned const* indices;  // three of each
};

struct gpu_shading_meshes {
  std::size_t count;
  gpu_shading_mesh const* meshes;
};

// OBJ as the file has it; COLLADA and glTF with y up and in metres, whatever the file states.
// Polygons come as triangles; points and lines are left out. Returns 0, the meshes until they are
// freed; or 1 with the reason in `message`, one line.
int gpu_shading_read_meshes(char const* path, gpu_shading_meshes const** meshes, char* message,
                            std::size_t message_size);

void gpu_shading_free_meshes(gpu_shading_meshes const* meshes);
}
