#include "host/shading_entries.h"

#include <string>
#include <string_view>

#include "host/run.h"

namespace gpu_shading::energyplus {
namespace {

void (*original_solar_beam)(State&, int, int) = nullptr;
void (*original_sky_shading)(State&) = nullptr;
void (*original_process_shadowing_input)(State&) = nullptr;
ShowFunction* original_show_severe = nullptr;
ShowFunction* original_show_continue = nullptr;

void set_time(Moment moment) {
  if (auto* const session = this_run().session) guarded([&] { session->set_time(moment); });
}

// Shading of the beam at a timestep and, with varying schedules, of every patch of the sky.
void solar_beam(State& state, int hour, int timestep) {
  set_time({hour, timestep});
  original_solar_beam(state, hour, timestep);
}

// Shading of the sky for the whole simulation.
void sky_shading(State& state) {
  set_time({});
  original_sky_shading(state);
}

// Here EnergyPlus warns that shades are opaque to its own pixel counting.
struct Silence {
  bool allowed = false;  // inside the function that warns, in a run that we shade
  bool active = false;   // the message has begun
};

Silence& silence() {
  thread_local Silence instance;
  return instance;
}

void process_shadowing_input(State& state) {
  auto const& model = this_run().model;
  silence() = {model && model->options.mode != Mode::off, false};
  original_process_shadowing_input(state);
  silence() = {};
}

void show_severe(State& state, std::string const& message, OtherFile first, OtherFile second) {
  constexpr std::string_view start =
      "The Shading Calculation Method of choice is \"PixelCounting\"";
  silence().active = silence().allowed && message.starts_with(start);
  if (!silence().active) original_show_severe(state, message, first, second);
}

void show_continue(State& state, std::string const& message, OtherFile first, OtherFile second) {
  if (!silence().active) original_show_continue(state, message, first, second);
}

}  // namespace

std::vector<EntryPatch> shading_entries() {
  return {
      watch("_ZN10EnergyPlus12SolarShading25FigureSolarBeamAtTimestepERNS_14EnergyPlusDataEii",
            &solar_beam, &original_solar_beam),
      watch("_ZN10EnergyPlus12SolarShading18SkyDifSolarShadingERNS_14EnergyPlusDataE", &sky_shading,
            &original_sky_shading),
      watch("_ZN10EnergyPlus12SolarShading21processShadowingInputERNS_14EnergyPlusDataE",
            &process_shadowing_input, &original_process_shadowing_input),
      watch("_ZN10EnergyPlus15ShowSevereErrorERNS_14EnergyPlusDataERKNSt7__cxx1112basic_"
            "stringIcSt11char_traitsIcESaIcEEESt8optionalISt17reference_wrapperINS_"
            "15InputOutputFileEEESE_",
            &show_severe, &original_show_severe),
      watch("_ZN10EnergyPlus17ShowContinueErrorERNS_14EnergyPlusDataERKNSt7__cxx1112basic_"
            "stringIcSt11char_traitsIcESaIcEEESt8optionalISt17reference_wrapperINS_"
            "15InputOutputFileEEESE_",
            &show_continue, &original_show_continue),
  };
}

}  // namespace gpu_shading::energyplus
