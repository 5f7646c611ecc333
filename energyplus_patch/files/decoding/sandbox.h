#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace gpu_shading::decoding {

// False with the address sanitizer, which reserves 16 TiB.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool limits_memory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool limits_memory = false;
#else
inline constexpr bool limits_memory = true;
#endif
#else
inline constexpr bool limits_memory = true;
#endif

struct Limits {
  std::uint64_t seconds;  // of processor time
  std::uint64_t memory;   // bytes of address space
};

// Ends this process when the one that started it, `parent`, ends.
void end_with(int parent);

// Takes from this process, for good, what decoding a file does not need: time and memory above the
// limits, core dumps, writing to files, other processes, the network, and reading any file but
// `input`, a descriptor, and those in `readable`. Without `readable`, and where the kernel has no
// landlock, all files can be read. Throws std::system_error if any of it fails.
struct Readable {
  std::filesystem::path folder;  // empty: none
};
void confine(Limits const& limits, int input, std::optional<Readable> const& readable);

}  // namespace gpu_shading::decoding
