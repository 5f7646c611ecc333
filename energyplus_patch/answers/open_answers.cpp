#include "answers/open_answers.h"

#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

RendererOptions watched_options(Options const& options, Messages const& messages) {
  auto watched = renderer_options(options);
  if (options.mode != Mode::require) watched.warn = messages.warning;
  return watched;
}

RenderedAnswers open_answers(SceneAssembly const& scene, std::span<SurfaceId const> receivers,
                             DeviceChoice const& device, Messages const& messages) {
  auto const& options = scene.model().options;
  auto rendering = watched_options(options, messages);
  rendering.device = device;
  Renderer renderer(scene.scene(), rendering);
  std::optional<AnswerCache> cache;
  if (options.cache) {
    auto const hash = scene.hash(renderer.scene(), renderer.device());
    AnswerLimits limits{{}, scene.optics().factor_names().size()};
    for (SurfaceId id = 0; id < renderer.scene().size(); ++id) {
      limits.areas.push_back(area(renderer.scene()[id].polygon));
    }
    cache.emplace(*options.cache, hash, std::move(limits), messages.remark);
  }
  RenderedAnswers answers(std::move(renderer), std::move(cache), receivers);
  answers.deploy(scene.optics().deployments());
  return answers;
}

void store_answers(RenderedAnswers& answers, Messages const& messages) {
  try {
    answers.store();
  } catch (Error const& error) {
    messages.warning(error.what());
  }
}

}  // namespace gpu_shading::energyplus
