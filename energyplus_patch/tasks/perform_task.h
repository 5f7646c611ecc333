#pragma once

#include <string>

#include "calculation/session.h"
#include "tasks/asked_task.h"

namespace gpu_shading::energyplus {

// Does what a task asks with the surfaces of a completed assembly: the text that it gives the user.
// Screens are all in place, schedules at their least transmittance. Throws Error.
std::string perform_task(Task const& task, SceneAssembly& scene, Messages const& messages);

// EnergyPlus has added all surfaces: starts the session or, where EnergyPlus is run for a task,
// does it, replies and throws TaskDone. Throws Error.
void begin(Session& session, Simulation simulation, AskedTask* task);

}  // namespace gpu_shading::energyplus
