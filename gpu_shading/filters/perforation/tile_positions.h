#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace gpu_shading {

// A position in a tile that repeats, as multiples of 2^-32 of its sides: what overflows is whole
// tiles.
inline glm::uvec2 part_of_tile(glm::dvec2 const& tiles) {
  auto const part = [](double position) {
    return static_cast<std::uint32_t>(std::llround((position - std::floor(position)) * 0x1p32));
  };
  return {part(tiles.x), part(tiles.y)};
}

// Rays at equal steps.
struct TilePositions {
  glm::uvec2 first;
  glm::uvec2 step;

  // All in m.
  TilePositions(glm::dvec2 const& at, glm::dvec2 const& by, glm::dvec2 const& tile)
      : first(part_of_tile(at / tile)), step(part_of_tile(by / tile)) {}

  glm::uvec2 operator[](std::uint32_t ray) const { return first + ray * step; }
};

// A position along a side of `count` equal parts: its part, and the rest as a fraction of that.
struct PlaceInTile {
  std::uint32_t part;
  float rest;

  [[gnu::always_inline]] PlaceInTile(std::uint32_t position, std::uint32_t count) {
    std::uint64_t const product = std::uint64_t{position} * count;
    part = static_cast<std::uint32_t>(product >> 32U);
    // As a signed number, which every processor converts.
    rest = static_cast<float>(static_cast<std::int32_t>(product >> 8U & 0xFFFFFFU)) * 0x1p-24F;
  }
};

}  // namespace gpu_shading
