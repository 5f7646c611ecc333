// The program that reads one file of meshes; see files/decoding/decoder.h. The answer to its one
// operation, meshes: the number of parts (64 bits), and for each its name and material (texts),
// whether it has texture coordinates (8 bits), the numbers of vertices and triangles (64 bits),
// then x, y, z (double) and u, v (float) of each vertex and three indices (32 bits) of each
// triangle.

#include <unistd.h>

#include "files/decoding/decoder.h"
#include "files/mesh_decoder/meshes.h"

namespace {

using namespace gpu_shading::decoding;

void decode(Request const& request, DecodedMessage& answer) {
  auto const parts = read_mesh_parts({input_path, request.name, request.any});
  answer.put(std::uint64_t{parts.size()});
  for (auto const& part : parts) {
    answer.put_text(part.name);
    answer.put_text(part.material);
    answer.put(static_cast<std::uint8_t>(part.texture.empty() ? 0 : 1));
    answer.put(std::uint64_t{part.positions.size() / 3});
    answer.put(std::uint64_t{part.indices.size() / 3});
    answer.put_all(part.positions);
    answer.put_all(part.texture);
    answer.put_all(part.indices);
  }
}

}  // namespace

int main() {
  // Without the destructors of libraries, which a damaged file may have led astray.
  _exit(run_decoder(true, decode));
}
