#include "mesh_decoder/meshes.h"

#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "mesh_decoder/gltf_nodes.h"
#include "mesh_decoder/neighbour_files.h"

namespace gpu_shading::decoding {
namespace {

constexpr std::array<std::string_view, 4> restricted{"obj", "dae", "gltf", "glb"};

[[noreturn]] void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "no reason is given" : why);
}

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

std::string ending_of(std::filesystem::path const& name) {
  auto ending = name.extension().string();
  ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// Assimp tries the readers of other formats too, by a file's content.
void keep_restricted_formats(Assimp::Importer& importer) {
  for (auto i = importer.GetImporterCount(); i-- > 0;) {
    auto const words = std::string(" ").append(importer.GetImporterInfo(i)->mFileExtensions) + ' ';
    bool const kept = std::any_of(restricted.begin(), restricted.end(), [&](auto const& ending) {
      return words.find(std::string(" ").append(ending) + ' ') != std::string::npos;
    });
    if (!kept) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

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

}  // namespace

std::vector<MeshPart> read_mesh_parts(MeshFile const& file) {
  auto const ending = ending_of(file.name);
  if (!file.any && std::find(restricted.begin(), restricted.end(), ending) == restricted.end()) {
    fail("expected an .obj, .dae, .gltf or .glb file (--gpu-shading-assets=any reads more)");
  }
  if (ending == "gltf" || ending == "glb" || is_glb(file.path)) check_gltf_nodes(file.path);
  Assimp::Importer importer;
  if (!file.any) keep_restricted_formats(importer);
  auto* const files = new NeighbourFiles(file.path, file.name, file.any);
  importer.SetIOHandler(files);  // which takes it over
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  auto const* scene = importer.ReadFile(file.name.filename().string(), 0);
  if (!files->refusal().empty()) fail(files->refusal());
  if (scene == nullptr) fail(importer.GetErrorString());
  check_corners(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr) fail(importer.GetErrorString());
  if (scene->mRootNode == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    fail("it has no complete scene");
  }
  Collector collector(*scene);
  collector.add(*scene->mRootNode, Matrix(), 0);
  return collector.take();
}

}  // namespace gpu_shading::decoding
