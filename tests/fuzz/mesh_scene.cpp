// Whatever Assimp makes of a file: a scene from the input's bytes.

#include <assimp/scene.h>

#include <bit>
#include <cstdlib>
#include <memory>

#include "files/mesh_decoder/scene_parts.h"
#include "fuzz.h"

namespace {

using gpu_shading::energyplus::Values;

float number(Values& values) { return std::bit_cast<float>(values.next<std::uint32_t>()); }

aiMesh* next_mesh(Values& values) {
  auto mesh = std::make_unique<aiMesh>();
  auto const flags = values.next<std::uint8_t>();
  mesh->mMaterialIndex = values.next<std::uint8_t>();
  mesh->mNumVertices = values.next<std::uint8_t>();
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  if ((flags & 1U) != 0) mesh->mTextureCoords[0] = new aiVector3D[mesh->mNumVertices];
  if (mesh->mNumVertices > 0) mesh->mVertices[0] = aiVector3D(number(values));
  mesh->mNumFaces = values.next_up_to<std::uint8_t>(16);
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    auto& face = mesh->mFaces[i];
    face.mNumIndices = (flags & 2U) != 0 ? values.next_up_to<std::uint16_t>(1100)
                                         : values.next_up_to<std::uint8_t>(4);
    face.mIndices = new unsigned[face.mNumIndices]{};
    if (face.mNumIndices > 0) face.mIndices[0] = values.next<std::uint8_t>();
    if ((flags & 4U) != 0 && face.mNumIndices > 1) face.mIndices[1] = values.next<std::uint32_t>();
  }
  return mesh.release();
}

// Below each other, or beside each other.
aiNode* next_nodes(Values& values) {
  auto* const root = new aiNode;
  auto* last = root;
  for (unsigned left = values.next_up_to<std::uint16_t>(1200); left > 0 && values.has_more();
       --left) {
    auto const kind = values.next<std::uint8_t>();
    auto* node = new aiNode;
    last->addChildren(1, &node);
    if ((kind & 1U) != 0) node->mTransformation.a1 = number(values);
    if ((kind & 2U) != 0) {
      node->mNumMeshes = values.next_up_to<std::uint8_t>(3);
      node->mMeshes = new unsigned[node->mNumMeshes];
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        node->mMeshes[i] = values.next_up_to<std::uint8_t>(4);
      }
    }
    if ((kind & 4U) != 0) {
      auto* child = new aiNode;
      node->addChildren(1, &child);
    }
    last = (kind & 8U) != 0 ? root : node;
  }
  return root;
}

std::unique_ptr<aiScene> next_scene(Values& values) {
  auto scene = std::make_unique<aiScene>();
  scene->mNumMeshes = values.next_up_to<std::uint8_t>(4);
  scene->mMeshes = new aiMesh*[scene->mNumMeshes];
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) scene->mMeshes[i] = next_mesh(values);
  scene->mNumMaterials = values.next_up_to<std::uint8_t>(2);
  scene->mMaterials = new aiMaterial*[scene->mNumMaterials];
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) scene->mMaterials[i] = new aiMaterial;
  scene->mRootNode = next_nodes(values);
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading;
  Values values(data, size);
  auto const scene = next_scene(values);
  try {
    decoding::check_corners(*scene);
    for (auto const& part : decoding::parts_of(*scene)) {
      auto const vertices = part.positions.size() / 3;
      energyplus::require(3 * vertices == part.positions.size());
      energyplus::require(part.texture.empty() || part.texture.size() == 2 * vertices);
      energyplus::require(!part.indices.empty() && part.indices.size() % 3 == 0);
      for (auto const index : part.indices) energyplus::require(index < vertices);
    }
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}
