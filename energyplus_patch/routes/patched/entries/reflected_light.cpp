#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/constant_schedule.h"

namespace gpu_shading::energyplus {
namespace {

PointerTo<symbol::init_surface_heat_balance> original_init_surface_heat_balance = nullptr;

Grounds find_grounds(State& state, ReflectedLight const& light) {
  auto const& functions = installation().functions;
  Grounds found{functions.light_of_ground(state), {}};
  for (auto const& receiver : light.receivers) {
    auto* const value = find_constant_schedule(state, functions.symbols(), receiver.schedule);
    if (value == nullptr) {
      throw Error(fmt::format("EnergyPlus has no schedule {} to set", receiver.schedule));
    }
    found.schedules.push_back(value);
  }
  return found;
}

void set_grounds(State& state, Run& run) {
  auto const& functions = installation().functions;
  if (!run.grounds) run.grounds = find_grounds(state, run.model->reflected_light);
  auto const weather = functions.sky_weather(state);
  double const ground = weather.ground_reflectance(functions.variable(state, run.grounds->light));
  auto const values = run.session->ground_reflectances({functions.moment(state), weather, ground});
  for (std::size_t i = 0; i < values.size(); ++i) {
    *run.grounds->schedules[i] = values[i];
  }
}

void note_light(State& state, Run& run) {
  auto const& functions = installation().functions;
  if (functions.sky_weather(state).open_ground() <= 0.0) return;
  if (run.irradiances.empty()) {
    for (auto const& receiver : run.session->recorded_receivers()) {
      run.irradiances.push_back(functions.irradiances_of(state, receiver));
    }
  }
  std::vector<DiffuseLight> light;
  for (auto const& numbers : run.irradiances) {
    light.push_back(functions.diffuse_light(state, numbers));
  }
  run.session->note_diffuse(functions.moment(state).hour, std::move(light));
}

// At each timestep EnergyPlus has the shading and the weather, and is about to irradiate surfaces.
void init_surface_heat_balance(State& state) {
  auto& run = this_run();
  if (run.session != nullptr && run.session->reflects_light()) {
    guarded([&] { set_grounds(state, run); });
  }
  original_init_surface_heat_balance(state);
}

// Surfaces are irradiated.
void at_end_of_timestep(State* state) {
  auto& run = this_run();
  if (run.session == nullptr || !run.session->records_light()) return;
  guarded([&] { note_light(*state, run); });
}

}  // namespace

std::vector<Entry> reflected_light_entries() {
  return {watch(symbol::init_surface_heat_balance, &init_surface_heat_balance,
                &original_init_surface_heat_balance)};
}

void record_light(State& state) {
  installation().functions.at_end_of_timesteps(state, &at_end_of_timestep);
}

}  // namespace gpu_shading::energyplus
