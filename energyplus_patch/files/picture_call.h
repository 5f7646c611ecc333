#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

#include "files/memory_file.h"
#include "files/picture_plugin/picture_plugin.h"
#include "files/plugin.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

// The content of a picture's file, written by a function of the picture plugin; `name` decides on
// the format. Throws Error.
template <typename Function, typename Picture>
std::string write_picture(char const* function, std::string const& name, Picture const& picture) {
  auto* const write = reinterpret_cast<Function*>(
      plugin_function(gpu_shading_picture_library, "pictures", function));
  MemoryFile const file;
  std::array<char, 512> message{};
  if (write(file.path().c_str(), name.c_str(), &picture, message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be drawn: {}", name, message.data()));
  }
  return file.contents();
}

}  // namespace gpu_shading::energyplus
