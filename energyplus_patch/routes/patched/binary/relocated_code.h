#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// The first instructions of a function, to be run elsewhere: at least `length` bytes of whole
// instructions from `code`. Empty, with the reason in `problem`, if one of them cannot be relocated
// (a relative jump or call) or decoded.
struct RelocatedCode {
  std::vector<std::uint8_t> bytes;
  // Offsets in `bytes` of 32-bit displacements relative to the instruction pointer. Each must be
  // reduced by the distance that the code is moved.
  std::vector<std::size_t> displacements;
};

std::optional<RelocatedCode> take_instructions(std::byte const* code, std::size_t available,
                                               std::size_t length, std::string& problem);

}  // namespace gpu_shading::energyplus
