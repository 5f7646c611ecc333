#include <atomic>

#include "routes/patched/binary/preserving_thunk.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"

// EnergyPlus asks for many luminances, most of which are not kept. Those go straight on to its own
// function.
extern "C" {
__attribute__((visibility("hidden"), used)) std::atomic<int> gpu_shading_sky_integrals{0};
__attribute__((visibility("hidden"), used)) void* gpu_shading_kept_luminance = nullptr;
__attribute__((visibility("hidden"),
               used)) double (*gpu_shading_own_luminance)(gpu_shading::energyplus::State const&,
                                                          int, double, double) = nullptr;
__attribute__((visibility("hidden"))) double gpu_shading_sky_luminance(
    gpu_shading::energyplus::State const&, int, double, double);
}
asm(R"(
  .pushsection .text
  .balign 16
  .hidden gpu_shading_sky_luminance
  .globl gpu_shading_sky_luminance
gpu_shading_sky_luminance:
  .cfi_startproc
  cmpl $0, gpu_shading_sky_integrals(%rip)
  jne 1f
  jmp *gpu_shading_own_luminance(%rip)
1:
  jmp *gpu_shading_kept_luminance(%rip)
  .cfi_endproc
  .popsection
)");

namespace gpu_shading::energyplus {
namespace {

PointerTo<symbol::tube_transmittance> original_tube = nullptr;
PointerTo<symbol::control_points> original_control_points = nullptr;
PointerTo<symbol::map_points> original_map_points = nullptr;

// While EnergyPlus integrates over a sky that is kept; nullptr otherwise.
DaylightMemory*& integrating() {
  thread_local DaylightMemory* instance = nullptr;
  return instance;
}

double sky_luminance(State const& state, int sky, double azimuth, double altitude) {
  auto const compute = [&] { return gpu_shading_own_luminance(state, sky, azimuth, altitude); };
  auto* const memory = integrating();
  return memory == nullptr ? compute() : memory->luminance(sky, azimuth, altitude, compute);
}

// What a tubular device lets pass. EnergyPlus adds it up for all points.
double tube(State& state, int device, double cosine, int radiation) {
  if (auto* const memory = daylight_memory()) memory->note_sums();
  return original_tube(state, device, cosine, radiation);
}

void compute_points(State& state, DaylightMemory::Points points, void (*original)(State&, int)) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) {
    original(state, points.second);
    return;
  }
  bool const sun = installation().functions.sun_in_weather(state);
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
  bool const ours = installation().serves(Need::daylight_memory) && run.session != nullptr &&
                    run.model && run.model->daylighting_answered;
  return ours ? &run.session->daylight_memory() : nullptr;
}

SkyIntegral::SkyIntegral(int hour, int window) : before_(integrating()) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) return;
  guarded([&] {
    if (memory->sky_recurs(hour, window)) sky_.emplace(*memory, hour, window);
  });
  if (!sky_) return;
  integrating() = memory;
  ++gpu_shading_sky_integrals;
}

SkyIntegral::~SkyIntegral() {
  if (!sky_) return;
  --gpu_shading_sky_integrals;
  integrating() = before_;
}

void begin_daylight_memory(State& state) {
  auto* const memory = daylight_memory();
  if (memory == nullptr) return;
  guarded([&] {
    // DaylightReflections looks at the rays one after another.
    bool const alone = daylight_reflections(state) == nullptr;
    memory->begin({.rays = alone && !this_run().session->daylight_varies(), .reflected = alone});
  });
}

std::vector<Entry> daylight_memory_entries() {
  static void* const kept =
      preserve_registers(reinterpret_cast<void*>(&sky_luminance), Result::real);
  gpu_shading_kept_luminance = kept;
  auto luminance =
      watch(symbol::sky_luminance, &gpu_shading_sky_luminance, &gpu_shading_own_luminance);
  luminance.patch.result.reset();  // it changes no register
  return {
      luminance,
      watch(symbol::tube_transmittance, &tube, &original_tube),
      watch(symbol::control_points, &control_points, &original_control_points),
      watch(symbol::map_points, &map_points, &original_map_points),
  };
}

}  // namespace gpu_shading::energyplus
