#pragma once

#include <cmath>
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

// Equal but for rounding.
inline bool is_near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b));
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

// The words of an object, up to `size` bytes or to the end of valid memory.
std::vector<std::byte const*> words_of(std::byte const* object, std::size_t size);

// The same, of an object that begins an allocated block.
std::vector<std::byte const*> words_of_block(std::byte const* object);

// The object of a class to which one of the state's words points; `table`: what the first word of
// such an object points to. Throws Unexpected.
std::byte* find_object(State& state, std::byte const* table);

template <typename Element>
struct ArrayOf {
  Element* data = nullptr;
  std::size_t size = 0;
  std::size_t row = 1;  // of the second index, where there are two
};

// An array whose indexes begin with 1. Throws Unexpected.
template <typename Element>
ArrayOf<Element> read_array(std::byte const* at, bool two_indexes = false) {
  auto const header = read_value<ArrayHeader>(at);
  expect(header && header->size <= header->capacity && header->data != nullptr);
  expect(header->shifted ==
         header->data - header->shift * static_cast<std::int64_t>(sizeof(Element)));
  ArrayOf<Element> array{reinterpret_cast<Element*>(header->data), header->size, 1};
  if (two_indexes) {
    expect(header->shift >= 2);
    array.row = static_cast<std::size_t>(header->shift - 1);
    expect(array.size % array.row == 0);
  } else {
    expect(header->shift == 1);
  }
  // Both ends can be read.
  expect(array.size > 0 && read_value<Element>(array.data) &&
         read_value<Element>(array.data + array.size - 1));
  return array;
}

}  // namespace gpu_shading::energyplus
