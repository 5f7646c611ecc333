#include "files/mesh_decoder/meshes.h"

#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <string_view>

#include "files/decoding/decoder.h"
#include "files/mesh_decoder/neighbour_files.h"
#include "files/mesh_decoder/scene_parts.h"

namespace gpu_shading::decoding {
namespace {

constexpr std::array<std::string_view, 4> restricted{"obj", "dae", "gltf", "glb"};

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

float max_coordinate(aiScene const& scene) {
  float largest = 0.0F;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    auto const& mesh = *scene.mMeshes[i];
    for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        auto const size = std::abs(mesh.mVertices[vertex][axis]);
        if (std::isfinite(size)) largest = std::max(largest, size);
      }
    }
  }
  return largest;
}

// By a power of two: exact.
void scale(aiScene const& scene, int exponent) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    auto& mesh = *scene.mMeshes[i];
    for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        auto& coordinate = mesh.mVertices[vertex][axis];
        coordinate = std::ldexp(coordinate, exponent);
      }
    }
  }
}

// Assimp 5.4 leaves out polygons that have triangles of less than about 1e-6 in area, such as the
// caps of thin tubes, so that they are made larger before and smaller after.
aiScene const* triangulate(Assimp::Importer& importer) {
  constexpr int large = 40;
  auto const largest = max_coordinate(*importer.GetScene());
  auto const exponent = largest > 0.0F ? large - std::ilogb(largest) : 0;
  scale(*importer.GetScene(), exponent);
  auto const* scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene != nullptr) scale(*scene, -exponent);
  return scene;
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
  scene = triangulate(importer);
  if (scene == nullptr) fail(importer.GetErrorString());
  if (scene->mRootNode == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    fail("it has no complete scene");
  }
  return parts_of(*scene);
}

}  // namespace gpu_shading::decoding
