#include "assets/mesh_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "assets/plugin.h"
#include "base/files.h"
#include "base/naming.h"
#include "base/text.h"
#include "gpu_shading/error.h"
#include "mesh_plugin/mesh_plugin.h"

namespace gpu_shading::energyplus {
namespace {

using FreeMeshes = decltype(&gpu_shading_free_meshes);

Mesh copied(gpu_shading_mesh const& from) {
  Mesh mesh;
  mesh.name = from.name;
  mesh.material = from.material;
  mesh.positions.reserve(from.vertices);
  for (std::size_t i = 0; i < from.vertices; ++i) {
    auto const* const at = from.positions + 3 * i;
    mesh.positions.emplace_back(at[0], at[1], at[2]);
    if (!std::isfinite(at[0] + at[1] + at[2])) {
      throw Error(fmt::format("vertex {} of {} is not a number", i + 1, mesh.name));
    }
    if (from.texture != nullptr) {
      mesh.texture.emplace_back(from.texture[2 * i], from.texture[2 * i + 1]);
    }
  }
  mesh.triangles.reserve(from.triangles);
  for (std::size_t i = 0; i < from.triangles; ++i) {
    auto const* const at = from.indices + 3 * i;
    mesh.triangles.push_back({at[0], at[1], at[2]});
  }
  return mesh;
}

}  // namespace

bool states_its_axes(std::filesystem::path const& path) {
  auto const ending = path.extension().string();
  for (char const* known : {".dae", ".gltf", ".glb"}) {
    if (same_name(ending, known)) return true;
  }
  if (same_name(ending, ".obj")) return false;
  throw Error(fmt::format("{}: expected an .obj, .dae, .gltf or .glb file", path.string()));
}

std::vector<Mesh> read_meshes(std::filesystem::path const& path) {
  static auto const read = reinterpret_cast<decltype(&gpu_shading_read_meshes)>(
      plugin_function(gpu_shading_mesh_library, "meshes", "gpu_shading_read_meshes"));
  static auto const free = reinterpret_cast<FreeMeshes>(
      plugin_function(gpu_shading_mesh_library, "meshes", "gpu_shading_free_meshes"));
  require_file(path);
  gpu_shading_meshes const* raw = nullptr;
  std::array<char, 512> message{};
  if (read(path.c_str(), &raw, message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be read: {}", path.string(), message.data()));
  }
  std::unique_ptr<gpu_shading_meshes const, FreeMeshes> const found(raw, free);
  std::vector<Mesh> meshes;
  meshes.reserve(found->count);
  naming(path.string(), [&] {
    for (std::size_t i = 0; i < found->count; ++i) meshes.push_back(copied(found->meshes[i]));
  });
  if (meshes.empty()) throw Error(fmt::format("{}: has no triangles", path.string()));
  return meshes;
}

}  // namespace gpu_shading::energyplus
