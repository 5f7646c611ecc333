#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace gpu_shading::energyplus {

// A hash of 128 bits (XXH3, the same on every machine).
using Hash = std::array<std::uint8_t, 16>;

// In hexadecimal digits.
inline std::string to_text(Hash const& hash) { return fmt::format("{:02x}", fmt::join(hash, "")); }

// Hashes values one after another. Lists are hashed with their length, so that following values
// cannot be confused with their elements.
class Digest {
  template <typename T>
  static constexpr bool plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

 public:
  Digest() : state_(XXH3_createState(), &XXH3_freeState) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
  }

  template <typename T>
  requires plain<T>
  void add(T value) {
    // In the order used in files.
    static_assert(std::endian::native == std::endian::little);
    XXH3_128bits_update(state_.get(), &value, sizeof value);
  }

  template <typename T>
  requires plain<T>
  void add(std::span<T const> values) {
    add(std::uint64_t{values.size()});
    XXH3_128bits_update(state_.get(), values.data(), values.size_bytes());
  }

  void add(std::string_view text) { add(std::span<char const>(text)); }
  void add(Hash const& hash) { add(std::span<std::uint8_t const>(hash)); }

  Hash result() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    return std::to_array(canonical.digest);
  }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

}  // namespace gpu_shading::energyplus
