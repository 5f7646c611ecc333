#include <glm/geometric.hpp>
#include <utility>

#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"

namespace gpu_shading::energyplus {
namespace {

// Below this, EnergyPlus counts a surface as opaque.
constexpr double opaque_below = 1e-6;

PointerTo<symbol::hit_obstruction> original_hit_obstruction = nullptr;
PointerTo<symbol::hit_interior> original_hit_interior = nullptr;
PointerTo<symbol::hit_between> original_hit_between = nullptr;
PointerTo<symbol::daylight_coefficients> original_coefficients = nullptr;

// What passes from a reference point to a point of a window. EnergyPlus's functions for this say
// yes or no; where something in between transmits, they say no, and the ray that EnergyPlus then
// sends on from the window is reduced instead.
struct Arrived {
  Vector at{};
  double share = 1.0;
};

Arrived& arrived() {
  thread_local Arrived instance;
  return instance;
}

// Nothing if the rays of this run are EnergyPlus's alone.
Session* answering_session() {
  auto const& run = this_run();
  return run.model && run.model->daylighting_answered ? run.session : nullptr;
}

// `follow`'s answer to a ray, from memory if it is known.
template <typename Follow>
double kept_answer(DaylightMemory::Ray kind, int window, Vector const& from, Vector const& to,
                   Follow const& follow) {
  auto* const memory = daylight_memory();
  auto* const kept = memory == nullptr ? nullptr : memory->rays();
  if (kept == nullptr) return follow();
  auto const question = DaylightMemory::question(kind, window, to_glm(from), to_glm(to));
  if (auto const* const known = kept->find(question)) return *known;
  double const answer = follow();
  guarded([&] { kept->keep(question, answer); });
  return answer;
}

double share_of(Session& session, Ray const& ray, int hour) {
  double const share = guarded([&] { return session.daylight_transmittance(ray, hour); });
  return share < opaque_below ? 0.0 : share;
}

// What EnergyPlus's surfaces and ours let pass.
double obstructions(State& state, int hour, int window, Vector const& origin,
                    Vector const& direction) {
  double const passed = original_hit_obstruction(state, hour, window, origin, direction);
  auto* const session = answering_session();
  if (session == nullptr || passed <= 0.0) return passed;
  return passed * share_of(*session, {to_glm(origin), to_glm(direction)}, hour);
}

double hit_obstruction(State& state, int hour, int window, Vector const& origin,
                       Vector const& direction) {
  auto const before = std::exchange(arrived(), {});  // of this ray alone
  double const reached = before.at == origin ? before.share : 1.0;
  auto const follow = [&] { return obstructions(state, hour, window, origin, direction); };
  return reached *
         kept_answer(DaylightMemory::Ray::through_window, window, origin, direction, follow);
}

// Whether nothing passes; `before`: what passed up to the start of the segment.
bool blocked(Session& session, Vector const& from, Vector const& to, double before) {
  constexpr int first_hour = 1;  // EnergyPlus does not say which; mostly it computes at this one
  Ray ray{to_glm(from), to_glm(to) - to_glm(from)};
  ray.length = glm::length(ray.direction);
  if (ray.length <= 0.0) return false;
  arrived() = {to, before * share_of(session, ray, first_hour)};
  return arrived().share <= 0.0;
}

bool follow_interior(State& state, int window, Vector const& from, Vector const& to) {
  arrived() = {};
  if (original_hit_interior(state, window, from, to)) return true;
  auto* const session = answering_session();
  return session != nullptr && blocked(*session, from, to, 1.0);
}

bool hit_interior(State& state, int window, Vector const& from, Vector const& to) {
  // What passes, or a negative number if EnergyPlus's own surfaces let nothing pass.
  auto const follow = [&] {
    bool const blocked = follow_interior(state, window, from, to);
    return blocked && arrived().share > 0.0 ? -1.0 : arrived().share;
  };
  double const passed = kept_answer(DaylightMemory::Ray::in_room, window, from, to, follow);
  arrived() = passed < 0.0 ? Arrived{} : Arrived{to, passed};
  return passed <= 0.0;
}

// From an interior window to an exterior one, after the way to the interior one.
bool hit_between(State& state, int first, int second, Vector const& from, Vector const& to) {
  if (original_hit_between(state, first, second, from, to)) return true;
  auto* const session = answering_session();
  if (session == nullptr) return false;
  return blocked(*session, from, to, arrived().at == from ? arrived().share : 1.0);
}

void coefficients(State& state) {
  if (auto* const session = answering_session()) guarded([&] { session->begin_daylighting(); });
  begin_daylight_memory();
  original_coefficients(state);
}

}  // namespace

std::vector<Entry> daylight_entries() {
  return {
      watch(symbol::hit_obstruction, &hit_obstruction, &original_hit_obstruction),
      watch(symbol::hit_interior, &hit_interior, &original_hit_interior),
      watch(symbol::hit_between, &hit_between, &original_hit_between),
      watch(symbol::daylight_coefficients, &coefficients, &original_coefficients),
  };
}

}  // namespace gpu_shading::energyplus
