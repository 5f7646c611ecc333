#include <cstddef>

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
  double const open = weather.open_ground();
  double const ground = open > 0.0 ? functions.variable(state, run.grounds->light) / open : 0.0;
  auto const values = run.session->ground_reflectances({functions.moment(state), weather, ground});
  for (std::size_t i = 0; i < values.size(); ++i) {
    functions.set_schedule(state, run.grounds->schedules[i], values[i]);
  }
}

// EnergyPlus has the shading and the weather of a timestep, and is about to irradiate its surfaces.
void at_timestep(State* state) {
  auto& run = this_run();
  if (run.session == nullptr || !run.session->reflects_light()) return;
  guarded([&] { set_grounds(*state, run); });
}

}  // namespace

void follow_reflected_light(State& state) {
  installation().functions.at_each_timestep(state, &at_timestep);
}

}  // namespace gpu_shading::energyplus
