#pragma once

#include <string>

#include "platform/messages.h"
#include "scene/scene_assembly.h"
#include "tasks/task.h"

namespace gpu_shading::energyplus {

// Does what a task asks with the surfaces of a completed assembly: the text that it gives the user.
// Screens are all in place, schedules at their least transmittance. Throws Error.
std::string perform_task(Task const& task, SceneAssembly& scene, Messages const& messages);

}  // namespace gpu_shading::energyplus
