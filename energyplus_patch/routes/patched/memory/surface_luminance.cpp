#include "routes/patched/memory/surface_luminance.h"

#include <glm/geometric.hpp>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t hours = 24;

std::vector<Covers*> find_arrays(State& state, DaylightClasses const& classes) {
  std::vector<Covers*> arrays;
  auto const* const object = find_object(state, classes.daylighting);
  auto const words = words_of_block(object);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != classes.hours) continue;
    auto const array = read_array<Covers>(object + i * sizeof(void*));
    if (array.size == hours) arrays.push_back(array.data);
  }
  return arrays;
}

std::int32_t find_placeholder(ReflectionMemory const& memory, Session const& session) {
  for (std::size_t number = 1; number < memory.ids.size(); ++number) {
    auto const id = memory.ids[number];
    if (id && session.is_placeholder(*id) && !is_mirrored(session.surface(*id).name)) {
      return static_cast<std::int32_t>(number);
    }
  }
  throw Unexpected{};
}

}  // namespace

SurfaceLuminance::SurfaceLuminance(Ray const& ray, ReflectionMemory const& memory,
                                   Session const& session, DaylightClasses const& classes,
                                   PointerTo<symbol::window_element> function,
                                   std::optional<Measured>& measured)
    : memory_(memory),
      session_(session),
      function_(function),
      measured_(measured),
      arrays_(find_arrays(ray.state, classes)),
      placeholder_(find_placeholder(memory, session)) {
  constexpr double up = 0.6;
  // Placeholders are upright.
  auto const to_front =
      -normal(session.surface(*memory.ids[static_cast<std::size_t>(placeholder_)]).polygon);
  Ray const front{
      ray.state, ray.window, ray.hour,
      glm::normalize(glm::dvec3{to_front.x, to_front.y, 0.0}) * 0.8 + glm::dvec3{0.0, 0.0, up},
      ray.horizontal};
  find_sums(front);
  find_reflectance(front);
}

// Calls EnergyPlus's function for an element that transmits all, of solid angle 1. Returns what it
// adds to the arrays.
std::vector<Covers> SurfaceLuminance::measure(Ray const& ray, Measured const& measured) const {
  std::vector<Covers> before;
  for (auto* const array : arrays_) {
    auto& sums = array[ray.hour - 1];
    before.push_back(sums);
    sums = {};
  }
  measured_ = measured;
  Vector const origin{0.0, 0.0, 0.0};
  Vector const direction{ray.direction.x, ray.direction.y, ray.direction.z};
  int sun_position = 0;
  double interior = 0.0;
  constexpr int control = 1;
  constexpr int first_of_two = 1;
  constexpr int two = 2;
  constexpr int in_zone = 1;
  // Not the last of the window's elements, so that the sun's disk is left out. Obstructions let
  // nothing pass.
  function_(ray.state, control, 1, first_of_two, two, first_of_two, two, 1, ray.window, ray.window,
            ray.hour, sun_position, 1.0, origin, direction, std::asin(ray.direction.z), 0, 0, 1.0,
            0.0, 1.0, 1.0, 0, 0, 0, std::atan2(direction.y, direction.x), origin, in_zone, 0, 0.0,
            origin, false, true, 0, 0.0, interior, 0);
  measured_.reset();
  std::vector<Covers> added;
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    auto& sums = arrays_[i][ray.hour - 1];
    added.push_back(sums);
    sums = before[i];
  }
  return added;
}

// Finds the sums by what one element adds: to the window's luminance that of the surface, and to
// the illuminance this times the ray's sine.
void SurfaceLuminance::find_sums(Ray const& ray) {
  auto const added = measure(ray, {placeholder_});
  for (std::size_t i = 0; i < added.size(); ++i) {
    double const sun = added[i][0].sun;
    if (is_near(sun, 1.0)) {
      expect(window_ == nullptr);
      window_ = arrays_[i];
      window_array_ = i;
    } else if (is_near(sun, ray.direction.z)) {
      expect(direct_ == nullptr);
      direct_ = arrays_[i];
    } else {
      expect(sun == 0.0);
    }
  }
  expect(window_ != nullptr && direct_ != nullptr);
}

double SurfaceLuminance::measure_sky(Ray const& ray, Measured const& measured) const {
  auto const added = measure(ray, measured)[window_array_][0].skies;
  double const sky = added[0] / ray.horizontal.skies[0];
  for (std::size_t i = 1; i < added.size(); ++i) {
    expect(is_near(added[i], sky * ray.horizontal.skies[i]));
  }
  return sky;
}

// Finds the reflectance of the placeholder by what changes when it does, at the moment at which it
// will be set.
void SurfaceLuminance::find_reflectance(Ray const& ray) {
  double const before = measure_sky(ray, {placeholder_});
  expect(before > 0.0);
  for (auto* const array : memory_.by_surface) {
    double* const value = &array[placeholder_ - 1];
    double const kept = *value;
    double const other = 2.0 * kept + 0.25;
    double const after = measure_sky(ray, {placeholder_, value, other});
    *value = kept;
    if (is_near(after, before)) continue;
    expect(reflectance_ == nullptr && is_near(after, before / kept * other));
    reflectance_ = value;
  }
  expect(reflectance_ != nullptr);
}

double SurfaceLuminance::sky(Ray const& ray, std::int32_t number) {
  auto const id = memory_.ids.at(static_cast<std::size_t>(number));
  if (!id) return measure_sky(ray, {number});
  bool const front = glm::dot(normal(session_.surface(*id).polygon), ray.direction) > 0.0;
  auto const [place, added] = known_.try_emplace({number, front, ray.hour}, 0.0);
  if (added) place->second = measure_sky(ray, {number});
  return place->second;
}

void SurfaceLuminance::set_placeholder(Ray const& ray, double sky_wanted) {
  *reflectance_ = 1.0;
  double const of_one = sky(ray, placeholder_);
  expect(of_one > 0.0);
  *reflectance_ = sky_wanted / of_one;
}

}  // namespace gpu_shading::energyplus
