#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "routes/patched/symbols/energyplus_symbols.h"

// Checked reads of EnergyPlus's memory: any address may be invalid.
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

// Thrown where something is not as expected.
struct Unexpected {};

inline void expect(bool holds) {
  if (!holds) throw Unexpected{};
}

// The beginning of ObjexxFCL's Array (ObjexxFCL/Array.hh).
struct ArrayHeader {
  std::byte const* table;
  std::uint64_t owner;
  std::uint64_t capacity;
  std::uint64_t size;
  void* block;
  std::byte* data;
  std::int64_t shift;
  std::byte* shifted;
};
static_assert(sizeof(ArrayHeader) == 64);

// The words of an object that begins an allocated block, or up to the end of valid memory.
std::vector<std::byte const*> words_of_block(std::byte const* object);

// The object of a class to which one of the state's words points; `table`: what the first word of
// such an object points to. Throws Unexpected.
std::byte* find_object(State& state, std::byte const* table);

}  // namespace gpu_shading::energyplus
