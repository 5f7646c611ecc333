#include "host/daylight_memory_entries.h"

#include "host/daylight_reflection_entries.h"
#include "host/run.h"

namespace gpu_shading::energyplus {
namespace {

double (*original_sky_luminance)(State const&, int, double, double) = nullptr;
double (*original_tube)(State&, int, double, int) = nullptr;
void (*original_control_points)(State&, int) = nullptr;
void (*original_map_points)(State&, int) = nullptr;

// While EnergyPlus integrates over the sky that a window sees; nullptr otherwise.
DaylightMemory*& integrating() {
  thread_local DaylightMemory* instance = nullptr;
  return instance;
}

double sky_luminance(State const& state, int sky, double azimuth, double altitude) {
  auto const compute = [&] { return original_sky_luminance(state, sky, azimuth, altitude); };
  auto* const memory = integrating();
  return memory == nullptr ? compute() : memory->luminance(sky, azimuth, altitude, compute);
}

// What a tubular device lets pass. EnergyPlus adds it up for all points.
double tube(State& state, int device, double cosine, int radiation) {
  if (auto* const memory = integrating()) memory->note_sums();
  return original_tube(state, device, cosine, radiation);
}

void compute_points(State& state, DaylightMemory::Points points, void (*original)(State&, int)) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) {
    original(state, points.second);
    return;
  }
  bool const sun = installation().functions.sun_in_weather(state).value_or(true);
  if (!guarded([&] { return memory->begin_points(points, sun); })) return;
  original(state, points.second);
  memory->end_points();
}

void control_points(State& state, int control) {
  compute_points(state, {DaylightMemory::Kind::control, control}, original_control_points);
}

void map_points(State& state, int map) {
  compute_points(state, {DaylightMemory::Kind::map, map}, original_map_points);
}

}  // namespace

DaylightMemory* daylight_memory() {
  auto const& run = this_run();
  bool const ours = installation().daylight_memory && run.session != nullptr && run.model &&
                    run.model->daylighting_answered;
  return ours ? &run.session->daylight_memory() : nullptr;
}

SkyIntegral::SkyIntegral(int hour, int window) : before_(integrating()) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) return;
  guarded([&] { sky_.emplace(*memory, hour, window); });
  integrating() = memory;
}

SkyIntegral::~SkyIntegral() { integrating() = before_; }

void begin_daylight_memory(State& state) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) return;
  guarded([&] {
    // DaylightReflections looks at the rays one after another.
    bool const alone = daylight_reflections(state) == nullptr;
    memory->begin({.rays = alone && !this_run().session->daylight_varies(), .reflected = alone});
  });
}

std::vector<EntryPatch> daylight_memory_entries() {
  return {
      watch("_ZN10EnergyPlus6Dayltg18DayltgSkyLuminanceERKNS_14EnergyPlusDataENS0_7SkyTypeEdd",
            &sky_luminance, &original_sky_luminance),
      watch("_ZN10EnergyPlus6Dayltg8TransTDDERNS_14EnergyPlusDataEidNS0_7RadTypeE", &tube,
            &original_tube),
      watch("_ZN10EnergyPlus6Dayltg25CalcDayltgCoeffsRefPointsERNS_14EnergyPlusDataEi",
            &control_points, &original_control_points),
      watch("_ZN10EnergyPlus6Dayltg25CalcDayltgCoeffsMapPointsERNS_14EnergyPlusDataEi", &map_points,
            &original_map_points),
  };
}

}  // namespace gpu_shading::energyplus
