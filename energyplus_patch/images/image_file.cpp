#include "images/image_file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>

#include "gpu_shading/error.h"
#include "images/image_library.h"

namespace gpu_shading::energyplus {
namespace {

using WriteImage = decltype(&gpu_shading_write_image);

WriteImage load_write_image() {
  constexpr char const* library = "libgpu_shading_images.so";
  Dl_info self{};
  dladdr(reinterpret_cast<void const*>(&load_write_image), &self);
  auto const path = std::filesystem::path(self.dli_fname).parent_path() / library;
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw Error(fmt::format("pictures need {}: {}", library, dlerror()));
  void* const function = dlsym(handle, "gpu_shading_write_image");
  if (function == nullptr) throw Error(fmt::format("{}: {}", path.string(), dlerror()));
  return reinterpret_cast<WriteImage>(function);
}

}  // namespace

void write_image(std::filesystem::path const& path, Image const& image) {
  static WriteImage const write = load_write_image();
  std::array<char, 512> message{};
  if (write(path.c_str(), image.width, image.height, image.channels, image.pixels.data(),
            message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), message.data()));
  }
}

}  // namespace gpu_shading::energyplus
