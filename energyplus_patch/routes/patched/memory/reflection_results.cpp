#include "routes/patched/memory/reflection_results.h"

#include <cmath>
#include <numbers>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// A number that EnergyPlus does not compute.
constexpr double untouched = -1234.5;

}  // namespace

std::optional<DiffuseResults> find_diffuse_results(ReflectionMemory const& memory,
                                                   std::vector<double*> const& candidates,
                                                   std::size_t offset, glm::dvec3 const& far,
                                                   std::function<void()> const& call) {
  Edits edits;
  for (auto const& receiver : memory.receivers) edits.set(receiver.ray_count, 0);
  auto const& first = memory.receivers.front();
  std::size_t const at = offset + static_cast<std::size_t>(first.number - 1);
  for (auto* const array : candidates) edits.set(&array[at], untouched);
  call();
  std::vector<double*> set;
  for (auto* const array : candidates) {
    if (array[at] == 0.0)
      set.push_back(array);
    else if (array[at] != untouched)
      return std::nullopt;
  }
  if (set.size() != 2) return std::nullopt;

  constexpr double distance = 1e9;
  edits.set(first.ray_count, 1);
  for (std::size_t point = 0; point < static_cast<std::size_t>(*first.point_count); ++point) {
    edits.set(&first.hit_numbers[point], point == 0 ? -1 : 0);
  }
  edits.set(&first.hits[0], distance * far);
  edits.set(&first.hit_normals[0], far);
  edits.set(&first.hit_reflectances[0], 1.0);
  edits.set(&first.solid_angles[0], -first.solid_angles[0]);
  call();
  double const expected =
      first.solid_angles[0] * first.cosines[0] / pi / static_cast<double>(*first.point_count);
  // A sum over the sky is 1 within its steps.
  auto const is_ground = [&](double value) { return std::abs(value / expected - 1.0) < 0.02; };
  if (set[0][at] == 0.0 && is_ground(set[1][at])) return DiffuseResults{set[0], set[1]};
  if (set[1][at] == 0.0 && is_ground(set[0][at])) return DiffuseResults{set[1], set[0]};
  return std::nullopt;
}

std::optional<std::pair<double*, double*>> find_specular_results(
    ReflectionMemory const& memory, int hour, std::function<void()> const& call) {
  Edits edits;
  for (auto const& receiver : memory.receivers) edits.set(receiver.obstruction_count, 0);
  auto const& first = memory.receivers.front();
  // A surface does not reflect to itself.
  edits.set(first.obstruction_count, 1);
  edits.set(&first.obstructions[0], first.number);
  std::size_t const at = memory.at(hour, first.number);
  for (auto* const array : memory.by_hour) edits.set(&array[at], untouched);
  call();
  std::vector<double*> set;
  for (auto* const array : memory.by_hour) {
    if (array[at] == untouched) continue;
    if (!is_near(array[at], untouched / *first.point_count)) return std::nullopt;
    set.push_back(array);
  }
  if (set.size() != 2) return std::nullopt;
  return std::pair(set[0], set[1]);
}

}  // namespace gpu_shading::energyplus
