#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// The first instructions of a function, to be run somewhere else: at least `length` bytes of whole
// instructions from `code`. Empty, with the reason in `problem`, where one of them cannot be moved
// (a relative jump or call) or cannot be decoded.
struct RelocatedCode {
  std::vector<std::uint8_t> bytes;
  // Offsets in `bytes` of 32-bit displacements relative to the instruction pointer, each to be
  // lowered by the distance the code is moved.
  std::vector<std::size_t> displacements;
};

std::optional<RelocatedCode> take_instructions(std::byte const* code, std::size_t available,
                                               std::size_t length, std::string& problem);

}  // namespace gpu_shading::energyplus
