#include "assets/labelled_image.h"

#include <fmt/format.h>

#include <array>

#include "assets/memory_file.h"
#include "assets/plugin.h"
#include "gpu_shading/error.h"
#include "picture_plugin/picture_plugin.h"

namespace gpu_shading::energyplus {

std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels) {
  static auto const write = reinterpret_cast<decltype(&gpu_shading_write_labelled)>(
      plugin_function(gpu_shading_picture_library, "pictures", "gpu_shading_write_labelled"));
  std::vector<gpu_shading_label> plain;
  plain.reserve(labels.size());
  for (auto const& label : labels) {
    plain.push_back(
        {label.text.c_str(), label.x, label.y, label.size, static_cast<int>(label.align)});
  }
  gpu_shading_labelled const all{image.width, image.height, image.pixels.data(),
                                 static_cast<int>(plain.size()), plain.data()};
  MemoryFile const file;
  std::array<char, 512> message{};
  if (write(file.path().c_str(), name.c_str(), &all, message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be drawn: {}", name, message.data()));
  }
  return file.contents();
}

}  // namespace gpu_shading::energyplus
