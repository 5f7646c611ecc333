#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace gpu_shading::energyplus {

// The contents of a file, which another process may replace at any moment; nothing if there is
// none. Throws Error, without the file's name, if it cannot be read or is larger than `max_bytes`.
std::optional<std::vector<std::byte>> read_cache_file(std::filesystem::path const& path,
                                                      std::size_t max_bytes);

// A lock on a file for the lifetime of this object. If another process holds it, or the file system
// has no locks, the cache works without it; at worst, answers stored at the same moment are lost.
class CacheLock {
 public:
  explicit CacheLock(std::filesystem::path const& path);

 private:
  std::shared_ptr<void> held_;
};

}  // namespace gpu_shading::energyplus
