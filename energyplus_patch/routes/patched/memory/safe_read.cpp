#include "routes/patched/memory/safe_read.h"

#include <malloc.h>
#include <sys/uio.h>
#include <unistd.h>

namespace gpu_shading::energyplus {

bool read_memory(void const* from, void* to, std::size_t size) {
  iovec const local{to, size};
  iovec const remote{const_cast<void*>(from), size};
  return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == static_cast<ssize_t>(size);
}

std::byte* read_pointer(void const* from) { return read_value<std::byte*>(from).value_or(nullptr); }

namespace {

// The words of an object, up to `size` bytes or to the end of valid memory.
std::vector<std::byte const*> words_of(std::byte const* object, std::size_t size) {
  std::vector<std::byte const*> words(size / sizeof(void*));
  if (read_memory(object, words.data(), words.size() * sizeof(void*))) return words;
  words.clear();
  for (std::size_t at = 0; at + sizeof(void*) <= size; at += sizeof(void*)) {
    auto const word = read_value<std::byte const*>(object + at);
    if (!word) break;
    words.push_back(*word);
  }
  return words;
}

}  // namespace

std::vector<std::byte const*> words_of_block(std::byte const* object) {
  return words_of(object, malloc_usable_size(const_cast<std::byte*>(object)));
}

std::byte* find_object(State& state, std::byte const* table) {
  // EnergyPlus's state has some 400 pointers.
  constexpr std::size_t reach = 0x4000;
  for (auto const* word : words_of(reinterpret_cast<std::byte const*>(&state), reach)) {
    if (word == nullptr || reinterpret_cast<std::uintptr_t>(word) % sizeof(void*) != 0) continue;
    if (read_value<std::byte const*>(word) == table) return const_cast<std::byte*>(word);
  }
  throw Unexpected{};
}

}  // namespace gpu_shading::energyplus
