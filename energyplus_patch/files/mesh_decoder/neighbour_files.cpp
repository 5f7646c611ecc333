#include "files/mesh_decoder/neighbour_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <system_error>

namespace gpu_shading::decoding {
namespace {

constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 30U;

// What follows a folder that is not there is only tidied by the first pass, as missing/../link to
// link: the second follows it.
std::filesystem::path resolved(std::filesystem::path const& path) {
  std::error_code failure;
  auto found = std::filesystem::weakly_canonical(path, failure);
  if (!failure) found = std::filesystem::weakly_canonical(found, failure);
  return failure ? path : found;
}

}  // namespace

NeighbourFiles::NeighbourFiles(char const* path, std::filesystem::path const& name, bool anywhere)
    : path_(path),
      name_(name.filename()),
      folder_(resolved(std::filesystem::absolute(name).parent_path())),
      anywhere_(anywhere) {}

std::filesystem::path NeighbourFiles::find(char const* name) const {
  std::string text(name);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (std::filesystem::path(text).lexically_normal() == name_) return path_;
  return resolved(folder_ / text);
}

bool NeighbourFiles::allows(std::filesystem::path const& path) const {
  if (anywhere_ || path == path_) return true;
  auto const inside = path.lexically_relative(folder_);
  return !inside.empty() && *inside.begin() != "..";
}

bool NeighbourFiles::Exists(char const* name) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(find(name), ignored);
}

Assimp::IOStream* NeighbourFiles::Open(char const* name, char const* mode) {
  auto const path = find(name);
  if (mode == nullptr || *mode != 'r') return nullptr;
  if (!allows(path)) {
    refusal_ = "it names " + path.string() + ", which is outside its folder " + folder_.string() +
               " (--gpu-shading-assets=any permits that)";
    return nullptr;
  }
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) return nullptr;
  auto const size = std::filesystem::file_size(path, failure);
  if (failure) return nullptr;
  if (size > max_bytes) {
    refusal_ = path.string() + " is larger than 1 GiB";
    return nullptr;
  }
  auto bytes = std::make_unique<std::uint8_t[]>(size);  // NOLINT: what MemoryIOStream owns
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.get()), static_cast<std::streamsize>(size));
  if (!file) return nullptr;
  constexpr bool owns = true;
  return new Assimp::MemoryIOStream(bytes.release(), size, owns);
}

void NeighbourFiles::Close(Assimp::IOStream* file) { delete file; }

}  // namespace gpu_shading::decoding
