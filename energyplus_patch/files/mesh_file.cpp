#include "files/mesh_file.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "files/decoding_process.h"
#include "files/mesh_decoder/meshes.h"
#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// The next part of an answer. `vertices_left`, `triangles_left`: how many there may still be.
Mesh next_part(DecodingProcess& decoding, std::size_t& vertices_left, std::size_t& triangles_left) {
  Mesh mesh;
  mesh.name = decoding.next_text();
  mesh.material = decoding.next_text();
  bool const has_texture = decoding.next<std::uint8_t>(0, 1) == 1;
  auto const vertices = decoding.next<std::uint64_t>(1, vertices_left);
  auto const triangles = decoding.next<std::uint64_t>(1, triangles_left);
  vertices_left -= vertices;
  triangles_left -= triangles;
  auto const positions = decoding.next_all<double>(3 * vertices);
  auto const texture = decoding.next_all<float>(has_texture ? 2 * vertices : 0);
  auto const indices = decoding.next_all<std::uint32_t>(3 * triangles);
  mesh.positions.reserve(vertices);
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    if (!std::isfinite(positions[i] + positions[i + 1] + positions[i + 2])) {
      throw Error(fmt::format("vertex {} of {} is not a finite number", i / 3 + 1, mesh.name));
    }
    mesh.positions.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
  }
  mesh.texture.reserve(texture.size() / 2);
  for (std::size_t i = 0; i < texture.size(); i += 2) {
    if (!std::isfinite(texture[i] + texture[i + 1])) {
      throw Error(
          fmt::format("texture coordinate {} of {} is not a finite number", i / 2 + 1, mesh.name));
    }
    mesh.texture.emplace_back(texture[i], texture[i + 1]);
  }
  mesh.triangles.reserve(triangles);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (indices[i + corner] >= vertices) DecodingProcess::throw_invalid();
    }
    mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  return mesh;
}

std::vector<Mesh> all_parts(DecodingProcess& decoding) {
  auto vertices_left = decoding::max_vertices;
  auto triangles_left = decoding::max_triangles;
  auto const parts = decoding.next<std::uint64_t>(0, decoding::max_parts);
  std::vector<Mesh> read;
  for (std::uint64_t i = 0; i < parts; ++i) {
    read.push_back(next_part(decoding, vertices_left, triangles_left));
  }
  decoding.finish();
  return read;
}

}  // namespace

bool states_its_axes(std::filesystem::path const& path, Assets assets) {
  auto const ending = path.extension().string();
  for (char const* known : {".dae", ".gltf", ".glb"}) {
    if (same_name(ending, known)) return true;
  }
  if (assets == Assets::any || same_name(ending, ".obj")) return false;
  throw Error(
      fmt::format("{}: expected an .obj, .dae, .gltf or .glb file (--gpu-shading-assets=any reads "
                  "more)",
                  path.string()));
}

MeshReading begin_reading_meshes(std::filesystem::path const& path, Assets assets) {
  require_file(path);
  auto const failure = fmt::format("{}: cannot be read", path.string());
  auto const decoding = naming(failure, [&] {
    return std::make_shared<DecodingProcess>("gpu_shading_mesh_decoder", "meshes", path, assets);
  });
  return [path, failure, decoding] {
    auto meshes = naming(failure, [&] { return all_parts(*decoding); });
    if (meshes.empty()) throw Error(fmt::format("{}: has no triangles", path.string()));
    return meshes;
  };
}

std::vector<Mesh> read_meshes(std::filesystem::path const& path, Assets assets) {
  return begin_reading_meshes(path, assets)();
}

}  // namespace gpu_shading::energyplus
