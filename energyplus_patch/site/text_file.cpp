#include "site/text_file.h"

#include <fmt/format.h>

#include <fstream>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::string read_text_file(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("{}: no such file", path.string()));
  // Others (a pipe, a device) may never come to an end.
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(fmt::format("{}: is not a file", path.string()));
  }
  std::string text(std::filesystem::file_size(path), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) throw Error(fmt::format("{}: cannot be read", path.string()));
  return text;
}

}  // namespace gpu_shading::energyplus
