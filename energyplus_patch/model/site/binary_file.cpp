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
  constexpr std::size_t usual = std::size_t{32} << 10U;
  if (place < begin_ || place + count > begin_ + window_.size()) {
    window_.resize(std::min<std::uintmax_t>(std::max(count, usual), size_ - place));
    file_.seekg(static_cast<std::streamoff>(place));
    if (!file_.read(window_.data(), static_cast<std::streamsize>(window_.size()))) {
      throw Error("cannot be read");
    }
    begin_ = place;
  }
  auto const first = window_.begin() + static_cast<std::ptrdiff_t>(place - begin_);
  return Bytes({first, first + static_cast<std::ptrdiff_t>(count)});
}

}  // namespace gpu_shading::energyplus::geojson
