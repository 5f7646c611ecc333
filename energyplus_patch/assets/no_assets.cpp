#include <fmt/format.h>

#include "assets/elevation_file.h"
#include "assets/image_file.h"
#include "assets/labelled_image.h"
#include "assets/mesh_file.h"
#include "assets/picture_sheet.h"
#include "assets/texture_file.h"
#include "base/files.h"
#include "gpu_shading/error.h"

// Where there are no readers of images and meshes, whose libraries are not compiled for Windows.

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void refuse(std::filesystem::path const& path) {
  require_file(path);
  throw Error(
      fmt::format("{}: images, meshes and GeoTIFF cannot be read on Windows", path.string()));
}

[[noreturn]] void refuse_picture(std::string const& name) {
  throw Error(fmt::format("{}: pictures cannot be written on Windows", name));
}

}  // namespace

decoding::Elevations read_elevations(std::filesystem::path const& path) { refuse(path); }

std::string encode_image(std::string const& name, Image const& /*image*/) { refuse_picture(name); }

std::string encode_labelled(std::string const& name, Image const& /*image*/,
                            std::vector<Label> const& /*labels*/) {
  refuse_picture(name);
}

bool states_its_axes(std::filesystem::path const& path, Assets /*assets*/) { refuse(path); }

std::vector<Mesh> read_meshes(std::filesystem::path const& path, Assets /*assets*/) {
  refuse(path);
}

std::string encode_sheet(std::string const& name, PictureSheet const& /*sheet*/) {
  refuse_picture(name);
}

bool is_animation(std::filesystem::path const& /*path*/) { return false; }

TextureInfo probe_texture(std::filesystem::path const& path, Assets /*assets*/) { refuse(path); }

std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path,
                                        TextureInfo const& /*info*/, Assets /*assets*/) {
  refuse(path);
}

}  // namespace gpu_shading::energyplus
