#include "answers/cache_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view extension = ".sunlit";
constexpr std::size_t hash_digits = 32;

bool is_ours(std::string_view name) {
  return name.size() == hash_digits + extension.size() &&
         name.find_first_not_of("0123456789abcdef") == hash_digits && name.ends_with(extension);
}

struct File {
  std::filesystem::path path;
  std::filesystem::file_time_type used;
  std::uint64_t bytes = 0;
};

// Other processes may remove files at the same time; missing files are skipped.
template <typename Visit>
void for_each_of_ours(std::filesystem::path const& folder, Visit const& visit) {
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    auto const name = entry->path().filename().string();
    if (!is_ours(name)) continue;
    std::error_code gone;
    if (!std::filesystem::is_regular_file(entry->symlink_status(gone))) continue;
    File file{entry->path(), entry->last_write_time(gone), 0};
    if (!gone) file.bytes = entry->file_size(gone);
    if (!gone) visit(file);
  }
}

}  // namespace

std::string cache_file_name(std::string_view digits) {
  return std::string(digits) + std::string(extension);
}

void prepare_cache_folder(CacheFolder const& cache) {
  auto const& folder = cache.path;
  std::error_code failure;
  if (cache.read_only) {
    if (std::filesystem::is_directory(folder, failure)) return;
    throw Error(fmt::format("--gpu-shading-cache: {}: no such folder", folder.string()));
  }
  std::filesystem::create_directories(folder, failure);
  if (int const error = find_access(folder); error != 0) {
    failure = std::error_code(error, std::generic_category());
  } else if (!std::filesystem::is_directory(folder)) {
    failure = std::make_error_code(std::errc::not_a_directory);
  } else {
    return;
  }
  throw Error(fmt::format("--gpu-shading-cache: {}: cannot be written to ({})", folder.string(),
                          failure.message()));
}

void bound_cache_folder(std::filesystem::path const& folder, std::uint64_t max_bytes,
                        std::filesystem::path const& kept) {
  std::vector<File> files;
  std::uint64_t bytes = 0;
  std::error_code ignored;
  for_each_of_ours(folder, [&](File const& file) {
    bytes += file.bytes;
    files.push_back(file);
  });
  std::ranges::sort(files, {}, &File::used);
  for (auto const& file : files) {
    if (bytes <= max_bytes) return;
    if (file.path.filename() == kept.filename()) continue;
    if (std::filesystem::remove(file.path, ignored)) bytes -= file.bytes;
  }
}

}  // namespace gpu_shading::energyplus
