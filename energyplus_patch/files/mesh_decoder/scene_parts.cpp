#include "files/mesh_decoder/scene_parts.h"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "files/decoding/decoder.h"

namespace gpu_shading::decoding {
namespace {

using Json = nlohmann::json;

constexpr std::string_view glb_mark = "glTF";

// Little-endian, as this machine.
std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// The JSON of a GLB: its first chunk.
std::string_view json_of(std::string_view glb) {
  constexpr std::size_t header = 12;
  constexpr std::size_t chunk_header = 8;
  constexpr std::size_t length_at = 8;
  if (glb.size() < header + chunk_header) fail("it is shorter than a GLB's header");
  auto const stated = number_at(glb, length_at);
  if (stated > glb.size()) {
    fail("its header states " + std::to_string(stated) + " bytes, but it has " +
         std::to_string(glb.size()));
  }
  std::string_view json;
  for (std::size_t at = header; at + chunk_header <= stated;) {
    std::size_t const length = number_at(glb, at);
    at += chunk_header;
    if (length > stated - at) {
      fail("a chunk states " + std::to_string(length) + " bytes, of which it has " +
           std::to_string(stated - at));
    }
    if (json.data() == nullptr) json = glb.substr(at, length);
    at += length;
  }
  return json;
}

// The number of each node's parent, or `none`.
class Parents {
 public:
  explicit Parents(Json const& nodes) : parents_(nodes.size(), none) {
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      if (!nodes[node].is_object()) fail("node " + std::to_string(node) + " is not an object");
      auto const children = nodes[node].find("children");
      if (children == nodes[node].end()) continue;
      for (auto const& child : *children) add(node, child);
    }
  }

  // A node whose parents do not end within max_depth is too deep or below itself.
  void check_depth() const {
    for (std::size_t node = 0; node < parents_.size(); ++node) {
      std::size_t depth = 0;
      for (auto above = node; parents_[above] != none; above = parents_[above]) {
        if (++depth <= max_depth) continue;
        fail("node " + std::to_string(node) + " is more than " + std::to_string(max_depth) +
             " nodes deep, or below itself");
      }
    }
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  void add(std::size_t parent, Json const& child) {
    if (!child.is_number_unsigned() || child.get<std::size_t>() >= parents_.size()) {
      fail("node " + std::to_string(parent) + " has a child that does not exist");
    }
    auto& known = parents_[child.get<std::size_t>()];
    if (known != none) {
      fail("node " + std::to_string(child.get<std::size_t>()) +
           " is a child of more than one node, or twice of one");
    }
    known = parent;
  }

  std::vector<std::size_t> parents_;
};

}  // namespace

bool is_glb(char const* path) {
  std::array<char, glb_mark.size()> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  return std::string_view(first.data(), first.size()) == glb_mark;
}

void check_gltf_nodes(char const* path) {
  std::ifstream file(path, std::ios::binary);
  std::string const bytes{std::istreambuf_iterator<char>(file), {}};
  auto const text = std::string_view(bytes).starts_with(glb_mark) ? json_of(bytes) : bytes;
  auto const root = Json::parse(text, nullptr, false);
  if (!root.is_object()) fail("it is not glTF: its JSON is damaged");
  auto const nodes = root.find("nodes");
  if (nodes == root.end()) return;
  if (!nodes->is_array()) fail("its nodes are not an array");
  Parents(*nodes).check_depth();
}

namespace {

using Matrix = aiMatrix4x4t<double>;

std::string material_of(aiScene const& scene, aiMesh const& mesh) {
  aiString name;
  if (mesh.mMaterialIndex < scene.mNumMaterials) {
    scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
  }
  return name.C_Str();
}

MeshPart placed(aiScene const& scene, aiNode const& node, aiMesh const& mesh, Matrix const& place) {
  MeshPart result;
  result.name = node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str();
  result.material = material_of(scene, mesh);
  result.positions.reserve(3 * std::size_t{mesh.mNumVertices});
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    auto const& vertex = mesh.mVertices[i];
    auto const point = place * aiVector3t<double>(vertex.x, vertex.y, vertex.z);
    result.positions.insert(result.positions.end(), {point.x, point.y, point.z});
  }
  if (mesh.HasTextureCoords(0)) {
    result.texture.reserve(2 * std::size_t{mesh.mNumVertices});
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      auto const& at = mesh.mTextureCoords[0][i];
      result.texture.insert(result.texture.end(), {at.x, at.y});
    }
  }
  result.indices.reserve(3 * std::size_t{mesh.mNumFaces});
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    auto const& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    result.indices.insert(result.indices.end(), face.mIndices, face.mIndices + 3);
  }
  return result;
}

// The parts of a scene. A mesh appears once for each node that uses it.
class Collector {
 public:
  explicit Collector(aiScene const& scene) : scene_(scene) {}

  void add(aiNode const& node, Matrix const& above, std::size_t depth) {
    if (depth > max_depth) {
      fail("its nodes are more than " + std::to_string(max_depth) + " deep");
    }
    auto const place = above * Matrix(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) fail("a node has a mesh that does not exist");
      auto const& mesh = *scene_.mMeshes[node.mMeshes[i]];
      vertices_ += mesh.mNumVertices;
      triangles_ += mesh.mNumFaces;
      check_size();
      auto part = placed(scene_, node, mesh, place);
      if (!part.indices.empty()) parts_.push_back(std::move(part));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], place, depth + 1);
  }

  std::vector<MeshPart> take() { return std::move(parts_); }

 private:
  void check_size() const {
    if (vertices_ <= max_vertices && triangles_ <= max_triangles && parts_.size() < max_parts) {
      return;
    }
    fail("it has more than " + std::to_string(max_vertices) + " vertices, " +
         std::to_string(max_triangles) + " triangles or " + std::to_string(max_parts) + " parts");
  }

  aiScene const& scene_;
  std::vector<MeshPart> parts_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

void check_corners(aiScene const& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    auto const& mesh = *scene.mMeshes[i];
    for (unsigned face = 0; face < mesh.mNumFaces; ++face) {
      auto const corners = mesh.mFaces[face].mNumIndices;
      auto const* const indices = mesh.mFaces[face].mIndices;
      if (corners > max_corners) {
        fail("a face has " + std::to_string(corners) + " corners, expected at most " +
             std::to_string(max_corners));
      }
      if (std::any_of(indices, indices + corners,
                      [&](unsigned index) { return index >= mesh.mNumVertices; })) {
        fail("a face has a vertex that does not exist");
      }
    }
  }
}

std::vector<MeshPart> parts_of(aiScene const& scene) {
  Collector collector(scene);
  collector.add(*scene.mRootNode, Matrix(), 0);
  return collector.take();
}

}  // namespace gpu_shading::decoding
