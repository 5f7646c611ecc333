#include <cstddef>

#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"

namespace gpu_shading::energyplus {
namespace {

void set_grounds(State& state, Run& run) {
  auto const& functions = installation().functions;
  auto const weather = functions.sky_weather(state);
  auto const values = run.session->ground_reflectances(
      {functions.moment(state), weather,
       functions.ground_reflectance(state, weather.open_ground())});
  if (run.grounds.empty()) {
    for (auto const& receiver : run.model->reflected_light.receivers) {
      run.grounds.push_back(functions.schedule_to_set(state, receiver.schedule));
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    functions.set_schedule(state, run.grounds[i], values[i]);
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
