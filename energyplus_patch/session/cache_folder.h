#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gpu_shading::energyplus {

// The folder of --gpu-shading-cache. Ours in it are HASH.sunlit, HASH.sunlit.WORD.tmp, where HASH
// is 32 hexadecimal digits, and the lock; nothing else is ever touched.

constexpr std::string_view cache_lock_name = "gpu_shading.lock";

// Makes the folder where it is missing. Throws Error when nothing can be written to it.
void prepare_cache_folder(std::filesystem::path const& folder);

std::string cache_file_name(std::string_view hash_digits);

// Removes files of answers, the least lately used first, until all take `most_bytes` at most;
// `kept` stays whatever it takes. What runs that were killed have left half-written goes too, an
// hour later.
void bound_cache_folder(std::filesystem::path const& folder, std::uint64_t most_bytes,
                        std::filesystem::path const& kept);

}  // namespace gpu_shading::energyplus
