#include "filters/perforation/pattern_rays.h"

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <type_traits>

#include "platform/instructions.h"

namespace gpu_shading {
namespace {

using Holes = PatternRays::Holes;
using Passed = PatternRays::Passed;

// The first ray's position and its step from ray to ray, in tiles, and a ray's displacement, m.
struct Rays {
  glm::vec2 first;
  glm::vec2 step;
  glm::vec2 ray_offset;
};

Rays rays_in(glm::dvec2 const& tile, glm::dvec2 const& first, glm::dvec2 const& step,
             glm::dvec2 const& ray_offset) {
  // Steps of whole tiles make no difference.
  glm::dvec2 const change = step / tile;
  return {glm::fract(first / tile), change - glm::round(change), ray_offset};
}

// What follows is the rule of screen.frag. As one text with it, by glm's vectors, the loop over
// rays takes 1.4 times as long; tests/support/sheet_cases.h holds both to the same answers.

// x, y: from the hole's centre, m.
template <SheetShape shape>
[[gnu::always_inline]] inline bool is_in_hole(Holes const& holes, float x, float y) {
  float const across = std::abs(x);
  float const up = std::abs(y);
  float const half = holes.half;
  if constexpr (shape == SheetShape::square_holes) return (across <= half) & (up <= half);
  if constexpr (shape == SheetShape::hexagonal_holes) {
    return (across <= half) & (0.5F * across + 0.8660254F * up <= half);
  }
  float const beyond = across > holes.straight ? across - holes.straight : 0.0F;
  return beyond * beyond + up * up <= half * half;
}

// u, v: from the hole's centre, in tiles. Holes are convex: a ray that is in a hole at both ends is
// in it all the way.
template <SheetShape shape>
[[gnu::always_inline]] inline bool is_in_at_both_ends(Holes const& holes,
                                                      glm::vec2 const& ray_offset, float u,
                                                      float v) {
  float const x = holes.width * u;
  float const y = holes.height * v;
  return is_in_hole<shape>(holes, x, y) &
         is_in_hole<shape>(holes, x + ray_offset.x, y + ray_offset.y);
}

// u, v: a position in tiles.
template <SheetShape shape, bool staggered>
[[gnu::always_inline]] inline bool passes_some_hole(Holes const& holes, glm::vec2 const& ray_offset,
                                                    float u, float v) {
  float const part_u = u - std::floor(u);
  float const part_v = v - std::floor(v);
  bool passes = is_in_at_both_ends<shape>(holes, ray_offset, part_u > 0.5F ? part_u - 1.0F : part_u,
                                          part_v > 0.5F ? part_v - 1.0F : part_v);
  if constexpr (staggered) {
    passes |= is_in_at_both_ends<shape>(holes, ray_offset, part_u - 0.5F, part_v - 0.5F);
  }
  return passes;
}

// Written so that the compiler can vectorise over rays. T: what an array holds, 1 or 0.
template <SheetShape shape, bool staggered, typename T>
[[gnu::always_inline]] inline void find_some(Holes const& holes, Rays const& rays,
                                             std::array<T, PatternRays::most>& passed) {
  for (int i = 0; i < PatternRays::most; ++i) {
    auto const steps = static_cast<float>(i);
    bool const passes = passes_some_hole<shape, staggered>(holes, rays.ray_offset,
                                                           rays.first.x + steps * rays.step.x,
                                                           rays.first.y + steps * rays.step.y);
    passed[static_cast<std::size_t>(i)] = passes ? T{1} : T{0};
  }
}

// Calls use(shape, staggered) with the holes' properties as compile-time constants.
template <typename Use>
[[gnu::always_inline]] inline auto with_kind(Holes const& holes, Use use) {
  auto const of_shape = [&](auto shape) __attribute__((always_inline)) {
    return holes.staggered ? use(shape, std::true_type()) : use(shape, std::false_type());
  };
  switch (holes.shape) {
    case SheetShape::square_holes:
      return of_shape(std::integral_constant<SheetShape, SheetShape::square_holes>());
    case SheetShape::hexagonal_holes:
      return of_shape(std::integral_constant<SheetShape, SheetShape::hexagonal_holes>());
    default:
      return of_shape(std::integral_constant<SheetShape, SheetShape::round_holes>());
  }
}

[[gnu::always_inline]] inline void find_all(Holes const& holes, Rays const& rays, Passed& passed) {
  auto const find = [&](auto shape, auto staggered) __attribute__((always_inline)) {
    find_some<shape, staggered>(holes, rays, passed);
  };
  with_kind(holes, find);
}

using Bytes = std::array<std::uint8_t, PatternRays::most>;

[[gnu::always_inline]] inline std::uint64_t find_bits(Holes const& holes, Rays const& rays) {
  alignas(64) Bytes passed;
  auto const find = [&](auto shape, auto staggered) __attribute__((always_inline)) {
    find_some<shape, staggered>(holes, rays, passed);
  };
  with_kind(holes, find);
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < passed.size(); i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, passed.data() + i, sizeof eight);
    // Moves bit 8 k to bit 56 + k.
    bits |= eight * 0x0102040810204080U >> 56U << i;
  }
  return bits;
}

}  // namespace

PatternRays::PatternRays(SheetInBeam const& sheet)
    : holes_{sheet.shape,  sheet.staggered, sheet.tile.x,
             sheet.tile.y, sheet.half_hole, sheet.half_slot},
      tile_(sheet.tile) {}

bool PatternRays::is_open(glm::dvec2 const& place) const { return passes(place, glm::dvec2(0.0)); }

bool PatternRays::passes(glm::dvec2 const& place, glm::dvec2 const& ray_offset) const {
  glm::vec2 const in_tile(glm::fract(place / tile_));
  return with_kind(holes_, [&](auto shape, auto staggered) {
    return passes_some_hole<shape, staggered>(holes_, ray_offset, in_tile.x, in_tile.y);
  });
}

void PatternRays::find_passing(glm::dvec2 const& first, glm::dvec2 const& step,
                               glm::dvec2 const& ray_offset, Passed& passed) const {
  run<find_all>(holes_, rays_in(tile_, first, step, ray_offset), passed);
}

std::uint64_t PatternRays::passing(glm::dvec2 const& first, glm::dvec2 const& step,
                                   glm::dvec2 const& ray_offset) const {
  return run<find_bits>(holes_, rays_in(tile_, first, step, ray_offset));
}

}  // namespace gpu_shading
