#include "model/site/binary_file.h"

#include <fmt/format.h>

namespace gpu_shading::energyplus::geojson {

Error damaged(std::string_view what) { return Error(fmt::format("is damaged: {}", what)); }

bool begins_with(std::filesystem::path const& path, std::string_view magic) {
  std::string first(magic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(first.data(), static_cast<std::streamsize>(first.size())) && first == magic;
}

Bytes BinaryFile::read(std::uintmax_t place, std::size_t count) {
  if (place > size_ || size_ - place < count) throw damaged("it ends too early");
  std::vector<char> bytes(count);
  file_.seekg(static_cast<std::streamoff>(place));
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(count))) {
    throw Error("cannot be read");
  }
  return Bytes(std::move(bytes));
}

}  // namespace gpu_shading::energyplus::geojson
