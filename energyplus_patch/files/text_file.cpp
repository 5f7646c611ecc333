#include "files/text_file.h"

#include <fmt/format.h>

#include <fstream>

#include "files/required_file.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::string read_text_file(std::filesystem::path const& path) {
  require_file(path);
  std::string text(std::filesystem::file_size(path), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) throw Error(fmt::format("{}: cannot be read", path.string()));
  return text;
}

}  // namespace gpu_shading::energyplus
