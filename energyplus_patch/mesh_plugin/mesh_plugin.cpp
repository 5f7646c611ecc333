#include "mesh_plugin/mesh_plugin.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/c_interface.h"

namespace {

struct Mesh {
  std::string name;
  std::string material;
  std::vector<double> positions;
  std::vector<float> texture;
  std::vector<unsigned> indices;
};

// The exported structure, together with the data that its pointers point to.
struct Meshes : gpu_shading_meshes {
  std::vector<Mesh> owned;
  std::vector<gpu_shading_mesh> views;
};

using Matrix = aiMatrix4x4t<double>;

std::string material_of(aiScene const& scene, aiMesh const& mesh) {
  aiString name;
  if (mesh.mMaterialIndex < scene.mNumMaterials) {
    scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
  }
  return name.C_Str();
}

Mesh placed(aiScene const& scene, aiNode const& node, aiMesh const& mesh, Matrix const& place) {
  Mesh result;
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

void add_node(aiScene const& scene, aiNode const& node, Matrix const& above,
              std::vector<Mesh>& meshes) {
  auto const place = above * Matrix(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    auto mesh = placed(scene, node, *scene.mMeshes[node.mMeshes[i]], place);
    if (!mesh.indices.empty()) meshes.push_back(std::move(mesh));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    add_node(scene, *node.mChildren[i], place, meshes);
  }
}

std::unique_ptr<Meshes> read(char const* path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  auto const* const scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr) fail(importer.GetErrorString());
  if (scene->mRootNode == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    fail("it has no complete scene");
  }
  auto meshes = std::make_unique<Meshes>();
  add_node(*scene, *scene->mRootNode, Matrix(), meshes->owned);
  meshes->views.reserve(meshes->owned.size());
  for (auto const& mesh : meshes->owned) {
    meshes->views.push_back({mesh.name.c_str(), mesh.material.c_str(), mesh.positions.size() / 3,
                             mesh.positions.data(),
                             mesh.texture.empty() ? nullptr : mesh.texture.data(),
                             mesh.indices.size() / 3, mesh.indices.data()});
  }
  meshes->count = meshes->views.size();
  meshes->meshes = meshes->views.data();
  return meshes;
}

}  // namespace

extern "C" EXPORTED int gpu_shading_read_meshes(char const* path, gpu_shading_meshes const** meshes,
                                                char* message, std::size_t message_size) {
  return guarded(message, message_size, [&] { *meshes = read(path).release(); });
}

extern "C" EXPORTED void gpu_shading_free_meshes(gpu_shading_meshes const* meshes) {
  delete static_cast<Meshes const*>(meshes);
}
