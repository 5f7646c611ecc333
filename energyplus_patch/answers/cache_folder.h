#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "model/options/options.h"

namespace gpu_shading::energyplus {

// The folder of --gpu-shading-cache. Our files in it are HASH.sunlit, where HASH is 32 hexadecimal
// digits, the lock, and the hidden folders of StagedFiles; other files are left alone.

constexpr std::string_view cache_lock_name = "gpu_shading.lock";

// Creates the folder if it is missing. Throws Error if it is not writable or, if it is only read,
// not there.
void prepare_cache_folder(CacheFolder const& folder);

std::string cache_file_name(std::string_view hash_digits);

// Evicts files of answers, least recently used first, until all take at most `max_bytes`; `kept`
// stays whatever its size.
void bound_cache_folder(std::filesystem::path const& folder, std::uint64_t max_bytes,
                        std::filesystem::path const& kept);

}  // namespace gpu_shading::energyplus
