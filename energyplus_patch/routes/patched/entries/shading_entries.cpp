#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/sky_multipliers.h"
#include "routes/patched/memory/sky_ratios.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

PointerTo<symbol::solar_beam_at_timestep> original_solar_beam = nullptr;
PointerTo<symbol::sky_shading> original_sky_shading = nullptr;
PointerTo<symbol::sky_view_factors> original_sky_view_factors = nullptr;
PointerTo<symbol::process_shadowing_input> original_process_shadowing_input = nullptr;
PointerTo<symbol::init_reflections> original_init_reflections = nullptr;
PointerTo<symbol::perform_solar_calculations> original_solar_calculations = nullptr;
PointerTo<symbol::shadow> original_shadow = nullptr;

// Whether EnergyPlus has the sun's shadows of this timestep, and asks for patches of the sky.
bool& has_sun() {
  thread_local bool has = false;
  return has;
}

void set_time(Moment moment) {
  if (auto* const session = this_run().session) guarded([&] { session->set_time(moment); });
}

// Shading of the beam at a timestep and, with varying schedules, of every patch of the sky.
void solar_beam(State& state, int hour, int timestep) {
  set_time({hour, timestep});
  if (auto* const memory = daylight_memory()) memory->note_shadows(hour);
  has_sun() = false;
  original_solar_beam(state, hour, timestep);
  if (auto* const session = this_run().session) guarded([&] { session->end_time(); });
}

// The sky's ratios while its shading is computed for the second time.
struct SecondPass {
  std::optional<SkyRatios> ratios;
  int patches = 0;  // until now
};
SecondPass& second_pass() {
  thread_local SecondPass pass;
  return pass;
}

void warn_of_long_wave() {
  messages_of(this_run())
      .warning(
          "EnergyPlus's sky ratios have an unexpected layout in memory: long-wave radiation is "
          "exchanged with the sky as if nothing shaded");
}

// EnergyPlus keeps sunlit fractions without reveals by time, those of the sky's patches as well,
// which would replace the sun's: they are kept for a time close to midnight.
void shadow(State& state, int hour, int timestep) {
  constexpr int last_hour = 24;
  bool const ours = this_run().session != nullptr && timestep > 0;
  if (ours && std::exchange(has_sun(), true)) {
    original_shadow(state, last_hour, 1);
  } else {
    original_shadow(state, hour, timestep);
  }
}

// Where EnergyPlus keeps its sky multipliers; nullptr until it is known.
std::byte*& multipliers_place() {
  thread_local std::byte* place = nullptr;
  return place;
}

void weigh_sky_patches(State& state, Session& session) {
  auto const& installed = installation();
  auto*& place = multipliers_place();
  auto const weather = installed.functions.sky_weather(state);
  if (weather.towards_sun.z <= 0.0 || weather.diffuse <= 0.0) return;
  if (place == nullptr) {
    place = find_sky_multipliers(state, installed.functions.symbols(),
                                 [&] { original_sky_view_factors(state); });
    original_sky_view_factors(state);
  }
  auto const multipliers = sky_multipliers_at(place);
  if (multipliers.empty()) {
    throw Error(
        "--gpu-shading-sky: EnergyPlus's sky multipliers have an unexpected layout in memory; "
        "expected energyplus");
  }
  auto const ids = read_surface_ids(state, *installed.surface_ids,
                                    static_cast<std::int32_t>(multipliers.size()), session);
  auto const weighed = session.sky_multipliers(weather);
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    auto const id = ids[i + 1];
    if (id && weighed[*id] >= 0.0) multipliers[i] = weighed[*id];
  }
}

// The sky's diffuse irradiance at a timestep with the sun up.
void sky_view_factors(State& state) {
  original_sky_view_factors(state);
  auto& run = this_run();
  if (run.session == nullptr || !run.model->options.weighs_sky_patches()) return;
  guarded([&] { weigh_sky_patches(state, *run.session); });
}

// Shading of the sky for the whole simulation.
void sky_shading(State& state) {
  multipliers_place() = nullptr;
  set_time({});
  original_sky_shading(state);
  auto* const session = this_run().session;
  if (session == nullptr || !session->follows_sky()) return;
  // A model that we made EnergyPlus follow the sky of keeps its view factors for long-wave
  // radiation: see SkyRatios.
  auto& pass = second_pass();
  pass = {};
  auto const& installed = installation();
  if (installed.serves(Need::long_wave)) {
    guarded([&] { pass.ratios = SkyRatios::find(state, installed.functions.symbols()); });
  }
  if (pass.ratios) {
    original_sky_shading(state);
  } else {
    warn_of_long_wave();
  }
}

// Called for each day, or for each timestep where shading is calculated as often.
void solar_calculations(State& state) {
  auto* const session = this_run().session;
  if (session != nullptr && session->records_days()) {
    guarded([&] {
      auto const& functions = installation().functions;
      session->begin_day(
          functions.day(state), [&] { return functions.beam_of_day(state); },
          [&] { return functions.wind_of_day(state); });
    });
  }
  original_solar_calculations(state);
}

// Here EnergyPlus warns that shades are opaque to its own pixel counting.
void process_shadowing_input(State& state) {
  auto const& model = this_run().model;
  bool const ours = model && model->options.mode != Mode::off;
  UnwantedMessages const unwanted([&](std::string_view message) {
    return ours &&
           message.starts_with("The Shading Calculation Method of choice is \"PixelCounting\"");
  });
  original_process_shadowing_input(state);
}

// Here EnergyPlus warns of surfaces that reach below the ground, as placeholders do.
void init_reflections(State& state) {
  UnwantedMessages const unwanted([](std::string_view message) {
    auto const& model = this_run().model;
    auto const name = message.substr(message.find('=') + 1);
    return message.starts_with("Calculation of reflected solar onto surface=") && model &&
           model->lean.is_placeholder(std::string(name.substr(0, name.find(" may be"))));
  });
  original_init_reflections(state);
}

}  // namespace

void note_sun() {
  auto& [ratios, patches] = second_pass();
  if (!ratios || ++patches < sky_rows * sky_columns) return;
  if (!ratios->restore()) warn_of_long_wave();
  ratios.reset();
}

std::vector<Entry> shading_entries() {
  return {
      watch(symbol::solar_beam_at_timestep, &solar_beam, &original_solar_beam),
      watch(symbol::shadow, &shadow, &original_shadow),
      watch(symbol::sky_shading, &sky_shading, &original_sky_shading),
      watch(symbol::sky_view_factors, &sky_view_factors, &original_sky_view_factors),
      watch(symbol::process_shadowing_input, &process_shadowing_input,
            &original_process_shadowing_input),
      watch(symbol::init_reflections, &init_reflections, &original_init_reflections),
      watch(symbol::perform_solar_calculations, &solar_calculations, &original_solar_calculations),
  };
}

}  // namespace gpu_shading::energyplus
