#include "render/sheet_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace gpu_shading {
namespace {

float smoothstep(float from, float to, float x) {
  float const t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

// Between the values for thirds of the way, straight.
float along(glm::vec4 const& thirds, float way) {
  float const places = 3.0F * way;
  float sum = thirds[0];
  for (int i = 0; i < 3; ++i) {
    sum += (thirds[i + 1] - thirds[i]) * std::clamp(places - static_cast<float>(i), 0.0F, 1.0F);
  }
  return sum;
}

float mix(float a, float b, float part) { return a + part * (b - a); }

double round_down(double x) {
  auto const whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1.0 : whole;
}

// Of a layer, 0 at the inside face and 1 at the outside one.
double depth_of(int layer, int layers) {
  return layers == 1 ? 0.5 : static_cast<double>(layer) / (layers - 1);
}

int around(int place, int count) {
  int const rest = place % count;
  return rest < 0 ? rest + count : rest;
}

// A pattern for rays of the whole way, in floats for several to be taken at once.
struct Pattern {
  float width;
  float height;
  float half;
  float straight;
  float ray_x;
  float ray_y;
};

// Those of a place, as parts of the tile, and of its change from ray to ray.
struct Places {
  float u;
  float v;
  float along_u;
  float along_v;
};

template <int shape>
[[gnu::always_inline]] inline bool is_in_hole(Pattern const& pattern, float x, float y) {
  float const across = std::abs(x);
  float const up = std::abs(y);
  float const half = pattern.half;
  if constexpr (shape == square_hole) return (across <= half) & (up <= half);
  if constexpr (shape == hexagonal_hole) {
    return (across <= half) & (0.5F * across + 0.8660254F * up <= half);
  }
  float const beyond = across > pattern.straight ? across - pattern.straight : 0.0F;
  return beyond * beyond + up * up <= half * half;
}

// Holes are convex: who is in one at both ends has been in it all the way.
template <int shape>
[[gnu::always_inline]] inline bool passes(Pattern const& pattern, float u, float v) {
  float const x = pattern.width * u;
  float const y = pattern.height * v;
  return is_in_hole<shape>(pattern, x, y) &
         is_in_hole<shape>(pattern, x + pattern.ray_x, y + pattern.ray_y);
}

template <int shape, bool staggered>
[[gnu::always_inline]] inline void find_passing(Pattern const& pattern, Places const& places,
                                                SheetRays::Ways& passed) {
  for (int i = 0; i < SheetRays::most_ways; ++i) {
    float const u = places.u + static_cast<float>(i) * places.along_u;
    float const v = places.v + static_cast<float>(i) * places.along_v;
    float const part_u = u - std::floor(u);
    float const part_v = v - std::floor(v);
    bool open = passes<shape>(pattern, part_u > 0.5F ? part_u - 1.0F : part_u,
                              part_v > 0.5F ? part_v - 1.0F : part_v);
    if constexpr (staggered) open |= passes<shape>(pattern, part_u - 0.5F, part_v - 0.5F);
    passed[static_cast<std::size_t>(i)] = open ? 1.0F : 0.0F;
  }
}

template <int shape>
[[gnu::always_inline]] inline void find_passing(Pattern const& pattern, bool staggered,
                                                Places const& places, SheetRays::Ways& passed) {
  if (staggered) {
    find_passing<shape, true>(pattern, places, passed);
  } else {
    find_passing<shape, false>(pattern, places, passed);
  }
}

[[gnu::always_inline]] inline void find_passing(Pattern const& pattern, int shape, bool staggered,
                                                Places const& places, SheetRays::Ways& passed) {
  switch (shape) {
    case square_hole:
      return find_passing<square_hole>(pattern, staggered, places, passed);
    case hexagonal_hole:
      return find_passing<hexagonal_hole>(pattern, staggered, places, passed);
    default:
      return find_passing<round_hole>(pattern, staggered, places, passed);
  }
}

using FindPassing = void(Pattern const& pattern, int shape, bool staggered, Places const& places,
                         SheetRays::Ways& passed);

void find_on_any_processor(Pattern const& pattern, int shape, bool staggered, Places const& places,
                           SheetRays::Ways& passed) {
  find_passing(pattern, shape, staggered, places, passed);
}

#ifdef __x86_64__
[[gnu::target("avx2,fma")]] void find_with_avx2(Pattern const& pattern, int shape, bool staggered,
                                                Places const& places, SheetRays::Ways& passed) {
  find_passing(pattern, shape, staggered, places, passed);
}

FindPassing* fastest() {
  bool const wide = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  return wide ? find_with_avx2 : find_on_any_processor;
}
#else
FindPassing* fastest() { return find_on_any_processor; }
#endif

}  // namespace

SheetRays::SheetRays(PerforatedScreen const& screen, SheetBlock const& sheet,
                     std::span<glm::vec4 const> regions, double pixel)
    : sheet_(sheet),
      image_(screen.tile() ? &*screen.tile() : nullptr),
      regions_(regions),
      ray_(sheet.ray.x, sheet.ray.y),
      tile_(sheet.tile.x, sheet.tile.y),
      blend_(smoothstep(sheet.tile.z, sheet.tile.w, static_cast<float>(pixel))) {
  if (image_ == nullptr) return;
  size_ = {image_->columns(), image_->rows()};
  for (int k = 0; k < sheet.kind.y; ++k) {
    layers_.push_back(in_image(depth_of(k, sheet.kind.y) * ray_));
  }
}

std::optional<float> SheetRays::everywhere() const {
  if (sheet_.kind.y == solid_sheet) return 0.0F;
  if (blend_ == 1.0F && sheet_.kind.w == 0) return sheet_.effective[3];
  return std::nullopt;
}

void SheetRays::whole_ways(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                           Ways& passed) const {
  if (image_ != nullptr || blend_ == 1.0F) {
    for (std::size_t i = 0; i < passed.size(); ++i, wanted >>= 1U) {
      if ((wanted & 1U) == 0) continue;
      passed[i] = part_of_way(first + static_cast<double>(i) * step, 0.0, 1.0);
    }
    return;
  }
  if (sheet_.kind.y == exact_sheet) {
    through_pattern(first, step, ray_, passed);
  } else {
    passed.fill(1.0F);
    Ways in_layer;
    for (int k = 0; k < sheet_.kind.y; ++k) {
      glm::dvec2 const from = first + depth_of(k, sheet_.kind.y) * ray_;
      through_pattern(from, step, glm::dvec2(0.0), in_layer);
      for (std::size_t i = 0; i < passed.size(); ++i) passed[i] *= in_layer[i];
    }
  }
  if (blend_ == 0.0F) return;
  for (float& way : passed) way += blend_ * (sheet_.effective[3] - way);
}

void SheetRays::through_pattern(glm::dvec2 const& first, glm::dvec2 const& step,
                                glm::dvec2 const& ray, Ways& passed) const {
  static FindPassing* const find = fastest();
  glm::vec2 const begin(glm::fract(first / tile_));
  // Whole tiles from ray to ray change nothing.
  glm::dvec2 const change = step / tile_;
  glm::vec2 const part(change - glm::round(change));
  Pattern const pattern{sheet_.tile.x,
                        sheet_.tile.y,
                        sheet_.hole.x,
                        sheet_.hole.y,
                        static_cast<float>(ray.x),
                        static_cast<float>(ray.y)};
  find(pattern, sheet_.kind.x, sheet_.hole.z != 0.0F, {begin.x, begin.y, part.x, part.y}, passed);
}

float SheetRays::part_of_way(glm::dvec2 const& place, double begin, double end) const {
  float passed = 0.0F;
  if (sheet_.kind.y == solid_sheet) return passed;
  if (blend_ < 1.0F) passed = through_holes(place, begin, end);
  if (blend_ > 0.0F) passed += blend_ * (through_effective(place, begin, end) - passed);
  return passed;
}

bool SheetRays::in_hole(glm::dvec2 const& from_centre) const {
  Pattern const pattern{0.0F, 0.0F, sheet_.hole.x, sheet_.hole.y, 0.0F, 0.0F};
  auto const x = static_cast<float>(from_centre.x);
  auto const y = static_cast<float>(from_centre.y);
  if (sheet_.kind.x == square_hole) return is_in_hole<square_hole>(pattern, x, y);
  if (sheet_.kind.x == hexagonal_hole) return is_in_hole<hexagonal_hole>(pattern, x, y);
  return is_in_hole<round_hole>(pattern, x, y);
}

std::optional<glm::dvec2> SheetRays::from_centre_of_hole(glm::dvec2 const& place) const {
  glm::dvec2 const part = glm::fract(place / tile_);
  glm::dvec2 from = tile_ * (part - glm::floor(part + 0.5));
  if (in_hole(from)) return from;
  from = tile_ * (part - 0.5);
  if (sheet_.hole.z != 0.0F && in_hole(from)) return from;
  return std::nullopt;
}

glm::dvec2 SheetRays::in_image(glm::dvec2 const& place) const {
  glm::dvec2 const turns = place / tile_;
  return size_ * glm::dvec2(turns.x - round_down(turns.x), turns.y - round_down(turns.y));
}

// As a texture that repeats is sampled, linearly.
float SheetRays::opacity(glm::dvec2 const& texel) const {
  auto const columns = static_cast<std::size_t>(image_->columns());
  auto const rows = static_cast<std::size_t>(image_->rows());
  double const x = texel.x + 0.5;
  double const y = texel.y + 0.5;
  auto const right = static_cast<std::size_t>(static_cast<int>(x));
  auto const above = static_cast<std::size_t>(static_cast<int>(y));
  auto const part_x = static_cast<float>(x - static_cast<double>(static_cast<int>(x)));
  auto const part_y = static_cast<float>(y - static_cast<double>(static_cast<int>(y)));
  std::size_t const left_column = right > 0 ? right - 1 : columns - 1;
  std::size_t const right_column = right < columns ? right : 0;
  std::uint16_t const* const texels = image_->opacity().data();
  std::uint16_t const* const low = texels + columns * (above > 0 ? above - 1 : rows - 1);
  std::uint16_t const* const high = texels + columns * (above < rows ? above : 0);
  float const below = mix(low[left_column], low[right_column], part_x);
  float const beyond = mix(high[left_column], high[right_column], part_x);
  return mix(below, beyond, part_y) * (1.0F / 65535.0F);
}

float SheetRays::solid(float opacity) const {
  if (sheet_.hole.w < 0.0F) return opacity;
  return opacity > sheet_.hole.w ? 1.0F : 0.0F;
}

float SheetRays::solid_at(glm::dvec2 const& place) const {
  if (image_ != nullptr) return solid(opacity(in_image(place)));
  return from_centre_of_hole(place) ? 0.0F : 1.0F;
}

float SheetRays::through_all_layers(glm::dvec2 const& place) const {
  glm::dvec2 const start = in_image(place);
  float most = 0.0F;
  for (glm::dvec2 const& layer : layers_) {
    glm::dvec2 texel = start + layer;
    if (texel.x >= size_.x) texel.x -= size_.x;
    if (texel.y >= size_.y) texel.y -= size_.y;
    most = std::max(most, solid(opacity(texel)));
    if (most >= 1.0F) break;
  }
  return 1.0F - most;
}

float SheetRays::through_layers(glm::dvec2 const& place, double begin, double end) const {
  bool const all = begin <= 0.0 && end >= 1.0;
  if (all && image_ != nullptr) return through_all_layers(place);
  int const layers = sheet_.kind.y;
  float most = 0.0F;
  auto const meet = [&](double depth) { most = std::max(most, solid_at(place + depth * ray_)); };
  if (!all) {
    meet(begin);
    meet(end);
  }
  for (int k = 0; k < layers && most < 1.0F; ++k) {
    double const depth = depth_of(k, layers);
    if (depth >= begin && depth <= end) meet(depth);
  }
  return 1.0F - most;
}

float SheetRays::through_holes(glm::dvec2 const& place, double begin, double end) const {
  if (image_ != nullptr || sheet_.kind.y != exact_sheet) return through_layers(place, begin, end);
  auto const from = from_centre_of_hole(place + begin * ray_);
  return from && in_hole(*from + (end - begin) * ray_) ? 1.0F : 0.0F;
}

float SheetRays::through_effective(glm::dvec2 const& place, double begin, double end) const {
  auto const way = static_cast<float>(end - begin);
  int const across = sheet_.kind.w;
  int const up = sheet_.image.x;
  if (across == 0) return along(sheet_.effective, way);
  glm::dvec2 const middle = place + 0.5 * (begin + end) * ray_;
  glm::dvec2 const at = glm::fract(middle / tile_) * glm::dvec2(across, up) - 0.5;
  glm::dvec2 const corner = glm::floor(at);
  glm::vec2 const part(at - corner);
  glm::vec4 const* const regions = &regions_[static_cast<std::size_t>(sheet_.kind.z)];
  auto const region = [&](int column, int row) {
    return along(regions[around(row, up) * across + around(column, across)], way);
  };
  int const left = static_cast<int>(corner.x);
  int const low = static_cast<int>(corner.y);
  float const below = mix(region(left, low), region(left + 1, low), part.x);
  float const above = mix(region(left, low + 1), region(left + 1, low + 1), part.x);
  return mix(below, above, part.y);
}

}  // namespace gpu_shading
