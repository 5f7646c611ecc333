#include "files/mesh_decoder/scene_parts.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "files/decoding/fail.h"

namespace gpu_shading::decoding {
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
    if (depth > deepest_node) {
      fail("its nodes are more than " + std::to_string(deepest_node) + " deep");
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
    if (vertices_ <= most_vertices && triangles_ <= most_triangles && parts_.size() < most_parts) {
      return;
    }
    fail("it has more than " + std::to_string(most_vertices) + " vertices, " +
         std::to_string(most_triangles) + " triangles or " + std::to_string(most_parts) + " parts");
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
      if (corners > most_corners) {
        fail("a face has " + std::to_string(corners) + " corners, expected at most " +
             std::to_string(most_corners));
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
