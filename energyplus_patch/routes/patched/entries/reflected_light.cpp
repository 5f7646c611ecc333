#include <cstddef>
#include <utility>
#include <vector>

#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"

namespace gpu_shading::energyplus {
namespace {

GroundNumbers find_grounds(State& state, ReflectedLight const& light) {
  auto const& functions = installation().functions;
  GroundNumbers found{functions.light_of_ground(state), {}};
  for (auto const& receiver : light.receivers) {
    found.schedules.push_back(functions.schedule_to_set(state, receiver.schedule));
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
    functions.set_schedule(state, run.grounds->schedules[i], values[i]);
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

// EnergyPlus has the shading and the weather of a timestep, and is about to irradiate its surfaces.
void at_timestep(State* state) {
  auto& run = this_run();
  if (run.session == nullptr || !run.session->reflects_light()) return;
  guarded([&] { set_grounds(*state, run); });
}

// Surfaces are irradiated.
void at_end_of_timestep(State* state) {
  auto& run = this_run();
  if (run.session == nullptr || !run.session->records_light()) return;
  guarded([&] { note_light(*state, run); });
}

}  // namespace

void follow_reflected_light(State& state) {
  installation().functions.at_each_timestep(state, &at_timestep);
}

void record_light(State& state) {
  installation().functions.at_end_of_timesteps(state, &at_end_of_timestep);
}

}  // namespace gpu_shading::energyplus
