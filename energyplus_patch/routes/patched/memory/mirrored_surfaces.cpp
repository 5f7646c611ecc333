#include "routes/patched/memory/mirrored_surfaces.h"

#include <cstring>
#include <vector>

#include "routes/patched/memory/own_memory.h"

namespace gpu_shading::energyplus {
std::optional<std::size_t> hand_over_mirrored_surfaces(State& state, Session& session,
                                                       StoredResult const& ids) {
  auto* const holder = read_pointer(reinterpret_cast<std::byte*>(&state) + ids.outer);
  auto* const origin = holder == nullptr ? nullptr : read_pointer(holder + ids.inner);
  if (origin == nullptr) return std::nullopt;
  // EnergyPlus counts surfaces from 1.
  auto* const array = origin + sizeof(std::int32_t);

  // Shading surfaces come first, each followed by its copy, if it has one, with id -1.
  auto const shading = session.shading_surfaces();
  std::vector<std::int32_t> kept(2 * shading.size());
  if (!read_memory(array, kept.data(), kept.size() * sizeof(std::int32_t))) return std::nullopt;
  std::vector<std::pair<std::size_t, SurfaceId>> copies;  // index in the array, original surface
  std::size_t at = 0;
  for (auto const id : shading) {
    if (kept[at++] != static_cast<std::int32_t>(id)) return std::nullopt;
    if (at < kept.size() && kept[at] == -1) copies.emplace_back(at++, id);
  }
  for (auto const& [place, original] : copies) {
    auto const id = static_cast<std::int32_t>(session.add_mirrored(original));
    std::memcpy(array + place * sizeof id, &id, sizeof id);
  }
  return copies.size();
}

}  // namespace gpu_shading::energyplus
