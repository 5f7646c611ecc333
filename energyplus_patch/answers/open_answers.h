#pragma once

#include <span>

#include "answers/rendered_answers.h"
#include "platform/messages.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// renderer_options() with the renderer's warnings. If a GPU is required, they are errors.
RendererOptions watched_options(Options const& options, Messages const& messages);

// Opens a device, and the cache that the model's options name, for the scene as it is now.
// `receivers`: see RenderedAnswers. Throws Error.
RenderedAnswers open_answers(SceneAssembly const& scene, std::span<SurfaceId const> receivers,
                             DeviceChoice const& device, Messages const& messages);

// Adds answers to their cache; warns if that cannot be written.
void store_answers(RenderedAnswers& answers, Messages const& messages);

}  // namespace gpu_shading::energyplus
