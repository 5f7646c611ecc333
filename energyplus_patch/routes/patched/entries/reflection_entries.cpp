#include <optional>

#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/reflection_memory.h"
#include "routes/patched/memory/solar_reflections.h"

namespace gpu_shading::energyplus {
namespace {

ReflectionFunctions& originals() {
  static ReflectionFunctions instance;
  return instance;
}
void (*original_init)(State&) = nullptr;

// The thread's run, as in this_run().
struct Reflections {
  bool looked = false;  // for EnergyPlus's memory
  std::optional<SolarReflections> active;
};
Reflections& reflections() {
  thread_local Reflections instance;
  return instance;
}

void warn() {
  forget_daylight_reflections();
  reflections().active.reset();
  messages_of(this_run())
      .warning(
          "EnergyPlus's solar reflections have an unexpected layout in memory: they do not count "
          "hidden casters (lean input, Geometry, SiteContext); with --gpu-shading-lean=off, "
          "shading "
          "surfaces count as opaque");
}

void init(State& state) {
  forget_daylight_reflections();
  auto& known = reflections();
  known.active.reset();
  known.looked = false;
  // EnergyPlus warns of surfaces that reach below the ground, as placeholders do.
  UnwantedMessages const unwanted([](std::string_view message) {
    auto const& model = this_run().model;
    auto const name = message.substr(message.find('=') + 1);
    return message.starts_with("Calculation of reflected solar onto surface=") && model &&
           model->lean.is_placeholder(std::string(name.substr(0, name.find(" may be"))));
  });
  original_init(state);
}

// Calls what computes reflections in this run, or EnergyPlus's own function.
template <typename... Hour>
void compute(bool (SolarReflections::*ours)(State&, Hour...), void (*original)(State&, Hour...),
             State& state, Hour... hour) {
  guarded([&] {
    auto* const active = solar_reflections(state);
    if (active == nullptr) {
      original(state, hour...);
    } else if (!(active->*ours)(state, hour...)) {
      warn();
    }
  });
}

void beam_diffuse(State& state, int hour) {
  compute(&SolarReflections::beam_diffuse, originals().beam_diffuse, state, hour);
}

void beam_specular(State& state, int hour) {
  compute(&SolarReflections::beam_specular, originals().beam_specular, state, hour);
}

void sky_diffuse(State& state) {
  compute(&SolarReflections::sky_diffuse, originals().sky_diffuse, state);
}

}  // namespace

SolarReflections* solar_reflections(State& state) {
  auto const& run = this_run();
  if (!run.model || !run.model->reflections_answered || run.session == nullptr) return nullptr;
  auto& known = reflections();
  if (known.looked) return known.active ? &*known.active : nullptr;
  known.looked = true;
  if (run.session->reflections() == nullptr) return nullptr;
  auto const& installed = installation();
  if (installed.serves(Need::reflections)) {
    auto memory = find_reflection_memory(state, *run.session, *installed.surface_ids,
                                         ReflectionClasses(installed.functions.symbols()));
    if (memory) return &known.active.emplace(std::move(*memory), *run.session, originals());
  }
  warn();
  return nullptr;
}

std::vector<Entry> reflection_entries() {
  return {
      watch(symbol::init_reflections, &init, &original_init),
      watch(symbol::beam_diffuse, &beam_diffuse, &originals().beam_diffuse),
      watch(symbol::beam_specular, &beam_specular, &originals().beam_specular),
      watch(symbol::sky_diffuse, &sky_diffuse, &originals().sky_diffuse),
  };
}

}  // namespace gpu_shading::energyplus
