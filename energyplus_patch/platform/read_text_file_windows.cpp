#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {

std::string read_text_file(std::filesystem::path const& path) {
  auto const refuse = [&](std::string_view why) {
    throw Error(fmt::format("{}: {}", path.string(), why));
  };
  require_file(path);
  std::error_code failure;
  auto const bytes = std::filesystem::file_size(path, failure);
  if (failure) refuse(failure.message());
  if (bytes > most_text_bytes) refuse("is larger than 1 GiB");
  std::string text(bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  if (!file) refuse("cannot be read");
  return text;
}

}  // namespace gpu_shading::energyplus
