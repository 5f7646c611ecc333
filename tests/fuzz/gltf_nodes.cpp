// What is checked of glTF before Assimp opens it.

#include "files/mesh_decoder/scene_parts.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading;
  auto const path = energyplus::file_of(energyplus::as_text(data, size), "mesh");
  try {
    decoding::is_glb(path.c_str());
    decoding::check_gltf_nodes(path.c_str());
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}
