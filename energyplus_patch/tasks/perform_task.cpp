#include "tasks/perform_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "answers/cache_folder.h"
#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "platform/text.h"
#include "reports/remarks.h"
#include "runs/run_times.h"
#include "tasks/samples/take_samples.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

// Each position of a screen, and each share of leaves, would need samples of its own.
void refuse_changing_bodies(SceneAssembly const& scene) {
  auto const& optics = scene.optics();
  auto const& leaves = scene.model().surroundings.leaf_schedules;
  for (auto const& name : optics.deployment_names()) {
    auto const [least, most] = optics.schedules().range(name);
    if (least < most) {
      bool const of_leaves = std::find(leaves.begin(), leaves.end(), name) != leaves.end();
      throw Error(
          fmt::format("{}: {} {}: has values from {} to {}, expected a constant value for samples",
                      of_leaves ? extension::tree::type : extension::perforated_screen::type,
                      of_leaves ? extension::tree::leaf_schedule_name.title
                                : extension::perforated_screen::deployment_schedule_name.title,
                      name, least, most));
    }
  }
}

SampledScene sampled_scene(SamplesTask const& task, SceneAssembly const& scene,
                           CachedRenderer const& answers) {
  SampledScene sampled;
  sampled.asked = task.asked;
  sampled.hash = to_text(scene.hash(answers.renderer().scene(), {}));
  sampled.fineness = describe_fineness(scene.model().options);
  sampled.schedules = scene.optics().factor_names();
  for (auto const id : answers.known().receivers) {
    sampled.receivers.push_back({scene.surfaces()[id].name, answers.area_vector(id)});
  }
  return sampled;
}

}  // namespace

CachedRenderer open_for_task(SceneAssembly& scene, std::vector<SurfaceId> const& receivers,
                             Messages const& messages) {
  auto const& options = scene.model().options;
  if (options.cache) prepare_cache_folder(*options.cache);
  auto answers = open_renderer(scene, receivers, options.device, messages);
  check_device(answers.renderer().device(), options, messages);
  describe_scene(scene, messages);
  scene.optics().update({});
  answers.deploy(scene.optics().deployments(), scene.positions());
  return answers;
}

std::vector<SurfaceId> choose_receivers(SceneAssembly const& scene,
                                        std::vector<SurfaceId> const& among, std::string_view flag,
                                        std::string const& pattern, std::string_view kind) {
  std::vector<SurfaceId> chosen;
  std::vector<std::string> names;
  for (auto const id : among) {
    names.push_back(scene.surfaces()[id].name);
    if (matches(pattern, names.back())) chosen.push_back(id);
  }
  if (!chosen.empty()) return chosen;
  throw Error(fmt::format("{} {}: no {} matches{}", flag, in_quotes(pattern), kind,
                          did_you_mean(pattern, names)));
}

std::string perform(SamplesTask const& task, SceneAssembly& scene, Messages const& messages) {
  auto const& options = scene.model().options;
  refuse_changing_bodies(scene);
  // All that a run asks for, because the samples depend on it.
  auto answers = open_for_task(scene, scene.receivers(), messages);
  auto const& device = answers.renderer().device();
  auto const sampled = sampled_scene(task, scene, answers);
  auto line = take_samples(task, options.update.sampling.value(), sampled, describe(device),
                           [&](std::span<SunDirection const> suns) {
                             return answers.at(suns, answers.known().receivers);
                           });
  write_cache(answers, messages);
  return line;
}

std::string perform(DirectionsTask const& task, SceneAssembly& scene, Messages const& messages) {
  auto answers = open_for_task(scene, scene.shown_receivers(), messages);
  auto const areas = scene.areas();
  auto const& factors = scene.optics().factors();
  std::vector<ReceiverFractions> receivers;
  for (auto const id : answers.known().receivers) {
    receivers.push_back({{scene.surfaces()[id].name, areas[id]}, {}});
  }
  auto const rendered = answers.at(task.directions, answers.known().receivers);
  for (std::size_t i = 0; i < task.directions.size(); ++i) {
    auto const sun = to_vector(task.directions[i]);
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      auto& [receiver, fractions] = receivers[k];
      fractions.push_back(sunlit_fraction(rendered[i][k].at(factors), receiver.area, sun));
    }
  }
  write_fractions(task.file, receivers);
  write_cache(answers, messages);
  return fmt::format("{} directions of {} receivers", task.directions.size(), receivers.size());
}

std::string perform_task(Task const& task, SceneAssembly& scene, Messages const& messages) {
  return std::visit([&](auto const& wanted) { return perform(wanted, scene, messages); }, task);
}

void begin(Session& session, Simulation simulation, AskedTask* task) {
  if (task == nullptr) {
    session.start(std::move(simulation));
    return;
  }
  auto& scene = session.complete(std::move(simulation.schedules));
  task->finish(perform_task(task->task(), scene, simulation.messages));
  throw TaskDone();
}

}  // namespace gpu_shading::energyplus
