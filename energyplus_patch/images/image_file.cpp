#include "images/image_file.h"

#include <fmt/format.h>

#include <array>

#include "gpu_shading/error.h"
#include "host/helper_library.h"
#include "images/image_library.h"

namespace gpu_shading::energyplus {

void write_image(std::filesystem::path const& path, Image const& image) {
  static auto const write = reinterpret_cast<decltype(&gpu_shading_write_image)>(
      helper_function(gpu_shading_image_library, "pictures", "gpu_shading_write_image"));
  std::array<char, 512> message{};
  if (write(path.c_str(), image.width, image.height, image.channels, image.pixels.data(),
            message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), message.data()));
  }
}

}  // namespace gpu_shading::energyplus
