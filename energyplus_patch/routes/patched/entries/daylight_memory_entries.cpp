#include <atomic>
#include <optional>

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
PointerTo<symbol::horizontal_illuminance> original_horizontal = nullptr;
PointerTo<symbol::inter_reflected> original_inter_reflected = nullptr;

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

// While EnergyPlus integrates over the sky that a window sees at an hour.
class SkyIntegral {
 public:
  SkyIntegral(int hour, int window) : before_(integrating()) {
    auto* const memory = daylight_memory();
    if (memory == nullptr) return;
    guarded([&] {
      if (memory->sky_recurs(hour, window)) sky_.emplace(*memory, hour, window);
    });
    if (!sky_) return;
    integrating() = memory;
    ++gpu_shading_sky_integrals;
  }
  SkyIntegral(SkyIntegral const&) = delete;
  SkyIntegral& operator=(SkyIntegral const&) = delete;
  ~SkyIntegral() {
    if (!sky_) return;
    --gpu_shading_sky_integrals;
    integrating() = before_;
  }

 private:
  DaylightMemory* before_;
  std::optional<DaylightMemory::SkyOfWindow> sky_;
};

// EnergyPlus asks for it where the sun is up.
void horizontal(State& state, Illuminance& at) {
  if (auto* const memory = daylight_memory()) memory->note_sun();
  original_horizontal(state, at);
}

void inter_reflected(State& state, int sun_position, int hour, int enclosure, int window) {
  // EnergyPlus counts positions of the sun for each window.
  auto* const memory = daylight_memory();
  DaylightMemory::Reflected const reflected{hour, sun_position == 1, enclosure, window};
  if (memory != nullptr && !memory->begin_reflected(reflected)) return;
  SkyIntegral const kept(hour, window);
  original_inter_reflected(state, sun_position, hour, enclosure, window);
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

void begin_daylight_memory() {
  auto* const memory = daylight_memory();
  if (memory == nullptr) return;
  guarded([&] { memory->begin(!this_run().session->daylight_varies()); });
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
      watch(symbol::horizontal_illuminance, &horizontal, &original_horizontal),
      watch(symbol::inter_reflected, &inter_reflected, &original_inter_reflected),
  };
}

}  // namespace gpu_shading::energyplus
