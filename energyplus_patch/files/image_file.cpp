#include "files/image_file.h"

#include <fmt/format.h>

#include <array>

#include "files/memory_file.h"
#include "files/picture_plugin/picture_plugin.h"
#include "files/plugin.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::string encode_image(std::string const& name, Image const& image) {
  static auto const write = reinterpret_cast<decltype(&gpu_shading_write_image)>(
      plugin_function(gpu_shading_picture_library, "pictures", "gpu_shading_write_image"));
  MemoryFile const file;
  std::array<char, 512> message{};
  if (write(file.path().c_str(), name.c_str(), image.width, image.height, image.channels,
            image.pixels.data(), message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be drawn: {}", name, message.data()));
  }
  return file.contents();
}

}  // namespace gpu_shading::energyplus
