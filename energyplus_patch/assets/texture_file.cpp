#include "assets/texture_file.h"

#include <fmt/format.h>

#include <array>

#include "assets/plugin.h"
#include "base/files.h"
#include "gpu_shading/error.h"
#include "image_plugin/image_plugin.h"

namespace gpu_shading::energyplus {

TextureInfo probe_texture(std::filesystem::path const& path) {
  static auto const probe = reinterpret_cast<decltype(&gpu_shading_probe_image)>(
      plugin_function(gpu_shading_image_library, "textures", "gpu_shading_probe_image"));
  require_file(path);
  gpu_shading_image_info info{};
  std::array<char, 512> message{};
  if (probe(path.c_str(), &info, message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: is not a readable image: {}", path.string(), message.data()));
  }
  if (info.width > max_texture_side || info.height > max_texture_side) {
    throw Error(fmt::format("{}: is {} x {} texels, expected at most {} per side", path.string(),
                            info.width, info.height, max_texture_side));
  }
  return {info.width, info.height, info.channels, info.alpha >= 0};
}

std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path,
                                        TextureInfo const& info) {
  static auto const read = reinterpret_cast<decltype(&gpu_shading_read_opacity)>(
      plugin_function(gpu_shading_image_library, "textures", "gpu_shading_read_opacity"));
  std::vector<std::uint16_t> opacity(static_cast<std::size_t>(info.width) *
                                     static_cast<std::size_t>(info.height));
  std::array<char, 512> message{};
  if (read(path.c_str(), info.width, info.height, opacity.data(), message.data(), message.size()) !=
      0) {
    throw Error(fmt::format("{}: cannot be read: {}", path.string(), message.data()));
  }
  return opacity;
}

}  // namespace gpu_shading::energyplus
