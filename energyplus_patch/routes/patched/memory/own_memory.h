#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

namespace gpu_shading::energyplus {

// Reads this process's own memory. Returns false instead of faulting if the address is invalid.
bool read_memory(void const* from, void* to, std::size_t size);

// The same for a value; nothing if the address is invalid.
template <typename Value>
std::optional<Value> read_value(void const* from) {
  static_assert(std::is_trivially_copyable_v<Value>);
  Value value;
  if (!read_memory(from, &value, sizeof value)) return std::nullopt;
  return value;
}

// A pointer; nullptr if the address is invalid.
std::byte* read_pointer(void const* from);

}  // namespace gpu_shading::energyplus
