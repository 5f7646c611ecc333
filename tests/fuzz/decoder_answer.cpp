// The answers of the decoding programs, of which nothing is trusted: beside this program, in their
// place, stands one that answers with the bytes of the file.

#include <cmath>
#include <string>

#include "files/decoding/decoded_message.h"
#include "files/image_file.h"
#include "files/mesh_file.h"
#include "fuzz.h"

namespace {

using namespace gpu_shading::energyplus;

void read_texture(std::filesystem::path const& path) {
  auto const info = probe_texture(path);
  require(info.width > 0 && info.height > 0 && info.channels > 0);
  auto const texels = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height);
  require(read_opacity(path, info).size() == texels);
}

void read_elevation_grid(std::filesystem::path const& path) {
  auto const [header, elevations] = read_elevations(path);
  require(std::isfinite(header.x) && std::isfinite(header.step_y));
  auto const cells =
      static_cast<std::size_t>(header.columns) * static_cast<std::size_t>(header.rows);
  require(elevations.empty() || elevations.size() == cells);
}

void read_all_meshes(std::filesystem::path const& path) {
  for (auto const& mesh : read_meshes(path)) {
    for (auto const& triangle : mesh.triangles) {
      for (auto const corner : triangle) require(corner < mesh.positions.size());
    }
    require(mesh.texture.empty() || mesh.texture.size() == mesh.positions.size());
  }
}

}  // namespace

// The first byte tells the operation, and whether the answer is good so far.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  namespace decoding = gpu_shading::decoding;
  Values values(data, size);
  auto const kind = values.next<std::uint8_t>();
  auto const rest = size > 0 ? as_text(data + 1, size - 1) : std::string_view();
  std::string answer;
  if ((kind & 4U) != 0) {
    constexpr auto done = decoding::Status::done;
    answer.append(reinterpret_cast<char const*>(&decoding::message_mark), sizeof(std::uint32_t));
    answer.append(reinterpret_cast<char const*>(&done), sizeof done);
  }
  auto const path = file_of(answer.append(rest), "answer.obj");
  return try_to([&] {
    switch (kind & 3U) {
      case 0:
        return read_texture(path);
      case 1:
        return read_elevation_grid(path);
      default:
        return read_all_meshes(path);
    }
  });
}
