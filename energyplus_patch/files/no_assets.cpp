#include <fmt/format.h>

#include "files/image_file.h"
#include "files/mesh_file.h"
#include "files/unconfined_decoding.h"
#include "gpu_shading/error.h"
#include "platform/files.h"

// Where there are no readers of images and meshes, whose libraries are not compiled for Windows.

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void refuse(std::filesystem::path const& path) {
  require_file(path);
  throw Error(
      fmt::format("{}: images, meshes and GeoTIFF cannot be read on Windows", path.string()));
}

}  // namespace

bool take_unconfined_decoding() { return false; }

decoding::Elevations read_elevations(std::filesystem::path const& path) { refuse(path); }

bool states_its_axes(std::filesystem::path const& path, Assets /*assets*/) { refuse(path); }

MeshReading begin_reading_meshes(std::filesystem::path const& path, Assets /*assets*/) {
  refuse(path);
}

std::vector<Mesh> read_meshes(std::filesystem::path const& path, Assets /*assets*/) {
  refuse(path);
}

TextureInfo probe_texture(std::filesystem::path const& path, Assets /*assets*/) { refuse(path); }

std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path,
                                        TextureInfo const& /*info*/, Assets /*assets*/) {
  refuse(path);
}

}  // namespace gpu_shading::energyplus
