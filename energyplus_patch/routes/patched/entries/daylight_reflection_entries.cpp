#include <optional>

#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/daylight_reflections.h"
#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

DaylightFunctions& originals() {
  static DaylightFunctions instance;
  return instance;
}
PointerTo<symbol::horizontal_illuminance> original_horizontal = nullptr;
PointerTo<symbol::point_factors> original_point_factors = nullptr;
PointerTo<symbol::map_factors> original_map_factors = nullptr;

// The thread's run, as in this_run().
struct Answering {
  Session const* session = nullptr;  // that was asked
  bool failed = false;
  std::optional<DaylightReflections> active;
};
Answering& answering() {
  thread_local Answering instance;
  return instance;
}

void warn() {
  answering().failed = true;  // it may be in use
  messages_of(this_run())
      .warning(
          "EnergyPlus's daylighting has an unexpected layout in memory: hidden casters (lean "
          "input, Geometry, SiteContext) dim light on its way to windows, but neither reflect it "
          "nor dim it on its way to reflecting surfaces");
}

// Whether `action` could be done.
template <typename Action>
bool answer(State& state, Action const& action) {
  return guarded([&] {
    auto* const active = daylight_reflections(state);
    if (active == nullptr) return false;
    try {
      action(*active);
      return true;
    } catch (Unexpected const&) {
      warn();
      return false;
    }
  });
}

// EnergyPlus asks for it where the sun is up.
void horizontal(State& state, Illuminance& at) {
  if (auto* const memory = daylight_memory()) memory->note_sun();
  original_horizontal(state, at);
  answer(state, [&](DaylightReflections& active) { active.add_horizontal(at); });
}

void closest(State& state, Vector const& from, Vector const& ray, int& surface, Vector& hit) {
  bool const done = answer(
      state, [&](DaylightReflections& active) { active.closest(state, from, ray, surface, hit); });
  if (!done) originals().closest(state, from, ray, surface, hit);
}

double sun_luminance(State& state, int hour, Vector const& ray, int surface, Vector const& hit) {
  double luminance = 0.0;
  bool const done = answer(state, [&](DaylightReflections& active) {
    luminance = active.sun_luminance(state, hour, ray, surface, hit);
  });
  return done ? luminance : originals().sun_luminance(state, hour, ray, surface, hit);
}

double sky_on_ground(State& state, Vector const& point, int altitudes, int azimuths) {
  double share = 0.0;
  bool const done = answer(state, [&](DaylightReflections& active) {
    share = active.sky_on_ground(state, point, altitudes, azimuths);
  });
  return done ? share : originals().sky_on_ground(state, point, altitudes, azimuths);
}

void inter_reflected(State& state, int sun_position, int hour, int enclosure, int window) {
  // EnergyPlus counts positions of the sun for each window.
  auto* const memory = daylight_memory();
  DaylightMemory::Reflected const reflected{hour, sun_position == 1, enclosure, window};
  if (memory != nullptr && !memory->begin_reflected(reflected)) return;
  SkyIntegral const kept(hour, window);
  bool const done = answer(state, [&](DaylightReflections& active) {
    active.inter_reflected(state, sun_position, hour, enclosure, window);
  });
  if (!done) originals().inter_reflected(state, sun_position, hour, enclosure, window);
}

void begin_factors(State& state) {
  answer(state, [](DaylightReflections& active) { active.begin_factors(); });
}

void point_factors(State& state, int control, int point, int hour, int& sun_position, int window,
                   int exterior_window, int columns, int rows, int shading_control) {
  begin_factors(state);
  original_point_factors(state, control, point, hour, sun_position, window, exterior_window,
                         columns, rows, shading_control);
}

void map_factors(State& state, int map, int point, int hour, int window, int exterior_window,
                 int shading_control) {
  begin_factors(state);
  original_map_factors(state, map, point, hour, window, exterior_window, shading_control);
}

}  // namespace

DaylightReflections* daylight_reflections(State& state) {
  auto const& run = this_run();
  auto& known = answering();
  if (!run.model || !run.model->daylighting_answered || !run.model->reflections_answered ||
      run.session == nullptr) {
    return nullptr;
  }
  if (known.session == run.session) {
    return known.active && !known.failed ? &*known.active : nullptr;
  }
  forget_daylight_reflections();
  known.session = run.session;
  bool const served = installation().serves(Need::daylight_reflections);
  if (!served || run.session->luminance() == nullptr) return nullptr;
  auto* const solar = solar_reflections(state);
  if (solar == nullptr) {
    warn();
    return nullptr;
  }
  auto const& symbols = installation().functions.symbols();
  auto functions = originals();
  functions.element = symbol::window_element.in(symbols);
  return &known.active.emplace(*solar, *run.session, functions, DaylightClasses(symbols));
}

void forget_daylight_reflections() {
  auto& known = answering();
  known.session = nullptr;
  known.failed = false;
  known.active.reset();
}

std::vector<Entry> daylight_reflection_entries() {
  auto& original = originals();
  return {
      watch(symbol::horizontal_illuminance, &horizontal, &original_horizontal),
      watch(symbol::closest_obstruction, &closest, &original.closest),
      watch(symbol::sun_luminance, &sun_luminance, &original.sun_luminance),
      watch(symbol::sky_on_ground, &sky_on_ground, &original.sky_on_ground),
      watch(symbol::inter_reflected, &inter_reflected, &original.inter_reflected),
      watch(symbol::point_factors, &point_factors, &original_point_factors),
      watch(symbol::map_factors, &map_factors, &original_map_factors),
  };
}

}  // namespace gpu_shading::energyplus
