// Meshes through the decoding process, as a run reads them: whatever Assimp does with the file,
// what comes back is meshes or one Error.

#include <array>
#include <cmath>

#include "files/mesh_file.h"
#include "fuzz.h"

// The first byte chooses the ending of the file's name.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  if (size == 0) return 0;
  constexpr std::array names{"a.obj", "a.dae", "a.gltf", "a.glb"};
  auto const path = file_of(as_text(data + 1, size - 1), names.at(data[0] % names.size()));
  return try_to([&] {
    for (auto const& mesh : read_meshes(path)) {
      for (auto const& triangle : mesh.triangles) {
        for (auto const corner : triangle) require(corner < mesh.positions.size());
      }
      for (auto const& at : mesh.positions) require(std::isfinite(at.x + at.y + at.z));
    }
  });
}
