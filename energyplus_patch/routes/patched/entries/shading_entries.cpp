#include "routes/patched/entries/shading_entries.h"

#include <string_view>

#include "routes/patched/entries/daylight_memory_entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/entries/unwanted_messages.h"

namespace gpu_shading::energyplus {
namespace {

void (*original_solar_beam)(State&, int, int) = nullptr;
void (*original_sky_shading)(State&) = nullptr;
void (*original_process_shadowing_input)(State&) = nullptr;
void (*original_solar_calculations)(State&) = nullptr;

void set_time(Moment moment) {
  if (auto* const session = this_run().session) guarded([&] { session->set_time(moment); });
}

// Shading of the beam at a timestep and, with varying schedules, of every patch of the sky.
void solar_beam(State& state, int hour, int timestep) {
  set_time({hour, timestep});
  if (auto* const memory = daylight_memory()) memory->note_shadows(hour);
  original_solar_beam(state, hour, timestep);
}

// Shading of the sky for the whole simulation.
void sky_shading(State& state) {
  set_time({});
  original_sky_shading(state);
}

// Called for each day, or for each timestep where shading is calculated as often.
void solar_calculations(State& state) {
  auto* const session = this_run().session;
  if (session != nullptr && session->records_days()) {
    guarded([&] {
      auto const& functions = installation().functions;
      if (auto const day = functions.day(state)) {
        session->begin_day(*day, [&] { return functions.beam_of_day(state); });
      }
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

}  // namespace

std::vector<EntryPatch> shading_entries() {
  auto warning = watch("_ZN10EnergyPlus12SolarShading21processShadowingInputERNS_14EnergyPlusDataE",
                       &process_shadowing_input, &original_process_shadowing_input);
  warning.needed = false;  // not before 24.2: the warning is written
  return {
      watch("_ZN10EnergyPlus12SolarShading25FigureSolarBeamAtTimestepERNS_14EnergyPlusDataEii",
            &solar_beam, &original_solar_beam),
      watch("_ZN10EnergyPlus12SolarShading18SkyDifSolarShadingERNS_14EnergyPlusDataE", &sky_shading,
            &original_sky_shading),
      warning,
  };
}

std::vector<EntryPatch> day_entries() {
  return {watch("_ZN10EnergyPlus12SolarShading24PerformSolarCalculationsERNS_14EnergyPlusDataE",
                &solar_calculations, &original_solar_calculations)};
}

}  // namespace gpu_shading::energyplus
