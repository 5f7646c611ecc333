#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "answers/cached_renderer.h"
#include "calculation/session.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {

// Each kind of task, for perform_task().
std::string perform(ListingTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(ViewsTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(SamplesTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(MapTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(DirectionsTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(MaskTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(SurroundingsTask const& task, SceneAssembly& scene, Messages const& messages);
std::string perform(ModulesTask const& task, SceneAssembly& scene, Messages const& messages);

// For tasks that render: the answers of a device that was checked, with schedules at their lowest
// value and screens fully deployed.
CachedRenderer open_for_task(SceneAssembly& scene, std::vector<SurfaceId> const& receivers,
                             Messages const& messages);

// Those of some receivers whose names match the pattern of a flag. `kind`: of them all, for the
// message. Throws Error where none does.
std::vector<SurfaceId> choose_receivers(SceneAssembly const& scene,
                                        std::vector<SurfaceId> const& among, std::string_view flag,
                                        std::string const& pattern, std::string_view kind);

// The scene that is rendered for a model, as JSON that the Python package reads: every surface with
// its vertices, optics and part in the shading rule, in the order of the scene. Transmittances are
// given at each half degree, textures as hexadecimal digits. Throws Error for a texture of more
// than 4096 x 4096 texels.
std::string scene_document(SceneAssembly& scene);

// Does what a task asks with the surfaces of a completed assembly: the text that it gives the user.
// Screens are all in place, schedules at their least transmittance. Throws Error.
std::string perform_task(Task const& task, SceneAssembly& scene, Messages const& messages);

// EnergyPlus has added all surfaces: starts the session or, where EnergyPlus is run for a task,
// does it, replies and throws TaskDone. Throws Error.
void begin(Session& session, Simulation simulation, AskedTask* task);

}  // namespace gpu_shading::energyplus
