#include "render/pattern_rays.h"

#include <cmath>
#include <glm/common.hpp>

#include "render/processor.h"

namespace gpu_shading {
namespace {

using Holes = PatternRays::Holes;
using Ways = PatternRays::Ways;

// The first ray's place and what it changes by from ray to ray, in tiles, and a ray's way, m.
struct Rays {
  glm::vec2 first;
  glm::vec2 step;
  glm::vec2 way;
};

// x, y: from the hole's centre, m.
template <int shape>
[[gnu::always_inline]] inline bool is_in_hole(Holes const& holes, float x, float y) {
  float const across = std::abs(x);
  float const up = std::abs(y);
  float const half = holes.half;
  if constexpr (shape == square_hole) return (across <= half) & (up <= half);
  if constexpr (shape == hexagonal_hole) {
    return (across <= half) & (0.5F * across + 0.8660254F * up <= half);
  }
  float const beyond = across > holes.straight ? across - holes.straight : 0.0F;
  return beyond * beyond + up * up <= half * half;
}

// u, v: from the hole's centre, in tiles. Holes are convex: who is in one at both ends has been in
// it all the way.
template <int shape>
[[gnu::always_inline]] inline bool is_in_at_both_ends(Holes const& holes, glm::vec2 const& way,
                                                      float u, float v) {
  float const x = holes.width * u;
  float const y = holes.height * v;
  return is_in_hole<shape>(holes, x, y) & is_in_hole<shape>(holes, x + way.x, y + way.y);
}

// u, v: a place in tiles.
template <int shape, bool staggered>
[[gnu::always_inline]] inline bool passes_some_hole(Holes const& holes, glm::vec2 const& way,
                                                    float u, float v) {
  float const part_u = u - std::floor(u);
  float const part_v = v - std::floor(v);
  bool passes = is_in_at_both_ends<shape>(holes, way, part_u > 0.5F ? part_u - 1.0F : part_u,
                                          part_v > 0.5F ? part_v - 1.0F : part_v);
  if constexpr (staggered) {
    passes |= is_in_at_both_ends<shape>(holes, way, part_u - 0.5F, part_v - 0.5F);
  }
  return passes;
}

// Written for the compiler to take several rays at once.
template <int shape, bool staggered>
[[gnu::always_inline]] inline void find_some(Holes const& holes, Rays const& rays, Ways& passed) {
  for (int i = 0; i < PatternRays::most; ++i) {
    auto const steps = static_cast<float>(i);
    bool const passes = passes_some_hole<shape, staggered>(
        holes, rays.way, rays.first.x + steps * rays.step.x, rays.first.y + steps * rays.step.y);
    passed[static_cast<std::size_t>(i)] = passes ? 1.0F : 0.0F;
  }
}

template <int shape>
[[gnu::always_inline]] inline void find_of_shape(Holes const& holes, Rays const& rays,
                                                 Ways& passed) {
  if (holes.staggered) {
    find_some<shape, true>(holes, rays, passed);
  } else {
    find_some<shape, false>(holes, rays, passed);
  }
}

[[gnu::always_inline]] inline void find_all(Holes const& holes, Rays const& rays, Ways& passed) {
  switch (holes.shape) {
    case square_hole:
      return find_of_shape<square_hole>(holes, rays, passed);
    case hexagonal_hole:
      return find_of_shape<hexagonal_hole>(holes, rays, passed);
    default:
      return find_of_shape<round_hole>(holes, rays, passed);
  }
}

using Find = void(Holes const& holes, Rays const& rays, Ways& passed);

void find_on_any_processor(Holes const& holes, Rays const& rays, Ways& passed) {
  find_all(holes, rays, passed);
}

#ifdef __x86_64__
[[gnu::target("avx2,fma")]] void find_with_avx2(Holes const& holes, Rays const& rays,
                                                Ways& passed) {
  find_all(holes, rays, passed);
}

Find* fastest() { return has_avx2() ? find_with_avx2 : find_on_any_processor; }
#else
Find* fastest() { return find_on_any_processor; }
#endif

template <int shape>
bool passes_any(Holes const& holes, glm::vec2 const& way, glm::vec2 const& place) {
  return holes.staggered ? passes_some_hole<shape, true>(holes, way, place.x, place.y)
                         : passes_some_hole<shape, false>(holes, way, place.x, place.y);
}

}  // namespace

PatternRays::PatternRays(SheetBlock const& sheet)
    : holes_{sheet.kind.x, sheet.hole.z != 0.0F, sheet.tile.x,
             sheet.tile.y, sheet.hole.x,         sheet.hole.y},
      tile_(sheet.tile.x, sheet.tile.y) {}

bool PatternRays::is_open(glm::dvec2 const& place) const { return passes(place, glm::dvec2(0.0)); }

bool PatternRays::passes(glm::dvec2 const& place, glm::dvec2 const& way) const {
  glm::vec2 const in_tile(glm::fract(place / tile_));
  switch (holes_.shape) {
    case square_hole:
      return passes_any<square_hole>(holes_, way, in_tile);
    case hexagonal_hole:
      return passes_any<hexagonal_hole>(holes_, way, in_tile);
    default:
      return passes_any<round_hole>(holes_, way, in_tile);
  }
}

void PatternRays::find_passing(glm::dvec2 const& first, glm::dvec2 const& step,
                               glm::dvec2 const& way, Ways& passed) const {
  static Find* const find = fastest();
  // Whole tiles from ray to ray change nothing.
  glm::dvec2 const change = step / tile_;
  find(holes_, {glm::fract(first / tile_), change - glm::round(change), way}, passed);
}

}  // namespace gpu_shading
