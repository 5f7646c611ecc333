#include "reports/remarks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/uncertain_receivers.h"
#include "model/site/surroundings.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

Names transmitting_surfaces(Model const& model) {
  Names names;
  for (auto const& [name, shade] : model.shades.by_surface) names.insert(name);
  for (auto const& [name, screen] : model.screens.by_surface) names.insert(name);
  return names;
}

std::vector<std::string> warn_of_actuated_schedules(SceneAssembly const& scene) {
  auto const& input = scene.model().shading;
  std::vector<std::string> lines;
  if (input.every_timestep || scene.model().options.update.every_timestep) return lines;
  auto const warn = [&](std::string_view field, std::string const& schedule) {
    lines.push_back(fmt::format(
        "{} {} is overridden by an EMS actuator, but shading is calculated for whole periods: the "
        "value at the time counts for all of it; see --gpu-shading-update",
        field, schedule));
  };
  for (auto const& [name, surface] : input.shading_surfaces) {
    if (!input.actuated.contains(surface.transmittance_schedule)) continue;
    warn("Transmittance Schedule", surface.transmittance_schedule);
    break;
  }
  for (auto const& schedule : scene.optics().deployment_names()) {
    if (input.actuated.contains(schedule)) warn("Deployment Schedule", schedule);
  }
  return lines;
}

void describe_surroundings(Surroundings const& surroundings, Messages const& messages) {
  if (surroundings.empty()) return;
  messages.eio("! <GPU Shading Surroundings>, Remark\n");
  for (auto remark : surroundings.remarks) {
    // Commas separate the file's fields.
    std::ranges::replace(remark, ',', ';');
    messages.eio(fmt::format("GPU Shading Surroundings,{}\n", remark));
  }
}

void list_transmitting_surfaces(SceneAssembly const& scene, Messages const& messages) {
  bool first = true;
  std::set<std::string_view> described;  // a mesh's triangles share its name
  for (auto const id : scene.shading_surfaces()) {
    auto const& surface = scene.surfaces()[id];
    if (described.contains(surface.name)) continue;
    auto optics =
        describe_optics(scene.model(), surface, scene.model().surroundings.texture_of(id));
    if (optics == "opaque") continue;
    described.insert(surface.name);
    if (first) messages.eio("! <GPU Shading Surface>, Surface Name, Transmittance\n");
    first = false;
    // Commas separate the file's fields.
    std::ranges::replace(optics, ',', ';');
    messages.eio(fmt::format("GPU Shading Surface,{},{}\n", surface.name, optics));
  }
}

// Receivers that EnergyPlus asked about.
std::vector<SurfaceId> asked_receivers(SunQuestions const& answers) {
  auto const& asked = answers.asked();
  auto const surfaces = answers.rendered().renderer().scene().size();
  std::vector<SurfaceId> receivers;
  for (SurfaceId id = 0; id < std::min(asked.size(), surfaces); ++id) {
    if (asked[id]) receivers.push_back(id);
  }
  return receivers;
}

constexpr double most_views = 0.99;

void list_errors(AnswerErrors const& errors, Options const& options, Messages const& messages) {
  bool const known = errors.sampled() > 0 || errors.not_measured() == 0;
  auto const stated = [&](double error) { return known ? fmt::format("{:.2g}", error) : ""; };
  messages.eio(fmt::format(
      "! <GPU Shading Error>, Target Error, Sampled Views, Error of 99 % of Sampled Views, Largest "
      "Error, Exact Views, Views Without Measured Error\n"
      "GPU Shading Error,{},{},{},{},{},{}\n",
      options.resolution ? "" : fmt::format("{}", options.error), errors.sampled(),
      stated(errors.within(most_views)), stated(errors.largest()), errors.exact(),
      errors.not_measured()));
}

void warn_of_missed_targets(SunQuestions const& answers, AnswerErrors const& errors,
                            Options const& options, Messages const& messages) {
  if (options.resolution) return;
  auto const& scene = answers.rendered().renderer().scene();
  auto receivers = asked_receivers(answers);
  std::erase_if(receivers, [&](SurfaceId id) {
    // Errors are kept in single precision.
    return errors.largest_of(id) <= static_cast<float>(options.error);
  });
  if (receivers.empty()) return;
  std::ranges::stable_sort(receivers, std::greater{},
                           [&](SurfaceId id) { return errors.largest_of(id); });
  std::vector<std::string> names;
  names.reserve(receivers.size());
  for (SurfaceId const id : receivers) {
    names.push_back(fmt::format("{} (within {:.2g})", scene[id].name, errors.largest_of(id)));
  }
  constexpr std::size_t max_listed = 3;
  messages.warning(fmt::format(
      "sunlit fractions of {} receiver{} cannot be brought within the target error of {}: {}; see "
      "docs/explanation/accuracy.md",
      names.size(), names.size() == 1 ? "" : "s", options.error, listed(names, max_listed)));
}

// Where errors are not measured, geometry foretells them.
void warn_of_uncertain_receivers(SunQuestions const& answers, AnswerErrors const& errors,
                                 Messages const& messages) {
  auto const& scene = answers.rendered().renderer().scene();
  auto receivers = asked_receivers(answers);
  std::erase_if(receivers, [&](SurfaceId id) { return errors.all_measured_of(id); });
  auto const found = find_uncertain_receivers(scene, receivers);
  auto const warn = [&](std::vector<SurfaceId> const& ids, std::string_view why) {
    if (ids.empty()) return;
    constexpr std::size_t max_listed = 3;
    std::vector<std::string> names;
    names.reserve(ids.size());
    for (SurfaceId const id : ids) names.push_back(scene[id].name);
    messages.warning(fmt::format("sunlit fractions may miss the target error {}: {}; see {}", why,
                                 listed(names, max_listed), "docs/explanation/limits.md"));
  };
  warn(found.behind_layers, "behind two parallel layers of blades at different distances");
  warn(found.narrow, "where less than a fifth of a bounding rectangle is filled, behind a screen");
}

std::string describe_ratio(double ratio) {
  constexpr double most = 1000.0;
  auto const times = ratio > most ? fmt::format("over {:.0f}", most)
                                  : fmt::format("{:.{}f}", ratio, ratio < 10.0 ? 1 : 0);
  return fmt::format(", {} times all reflected light", times);
}

std::string describe_expected_error(double error, Sampling sampling) {
  // The paper's grids have no estimate.
  if (error == 0.0) return "";
  double const goal = error_goal(sampling.density);
  std::string remark =
      fmt::format("; estimated mean error of the worst receiver's sunlit fraction {:.4f}", error);
  if (error >= goal) {
    remark += fmt::format(
        ", above the goal of {:.4f}; {} is more accurate", goal,
        sampling.density == Sampling::Density::fine ? "timestep" : "sampled:fine or timestep");
  }
  return remark;
}

}  // namespace

void check_device(DeviceInfo const& device, Options const& options, Messages const& messages) {
  if (!device.software) return;
  if (options.mode == Mode::require) {
    throw DeviceError(
        fmt::format("--gpu-shading=require: no GPU available, only {}; see gpu_shading devices",
                    describe(device)));
  }
  if (!options.device.device) {
    messages.remark(
        fmt::format("no GPU available; computing on the CPU, {} thread{}; see gpu_shading devices",
                    device.threads, device.threads == 1 ? "" : "s"));
  }
}

std::vector<std::string> warnings_of(SceneAssembly const& scene) {
  auto const& model = scene.model();
  auto lines = model.shades.warnings;
  auto const add = [&](std::vector<std::string> const& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  add(model.screens.warnings());
  add(model.ray_warnings);
  if (!model.transform_warning.empty()) lines.push_back(model.transform_warning);
  if (auto line = scene.warn_of_rounding(); !line.empty()) lines.push_back(std::move(line));
  add(model.warnings);
  add(model.surroundings.warnings);
  add(warn_of_own_buildings(model.surroundings.buildings, scene.surfaces(), model.shading));
  add(warn_of_covers(scene.surfaces(), model.shading, transmitting_surfaces(model)));
  add(warn_of_actuated_schedules(scene));
  return lines;
}

std::vector<std::string> remarks_of(Model const& model) {
  auto lines = model.remarks;
  if (!model.lean.remark.empty()) lines.push_back(model.lean.remark);
  auto const& surroundings = model.surroundings.remarks;
  lines.insert(lines.end(), surroundings.begin(), surroundings.end());
  return lines;
}

void describe_scene(SceneAssembly const& scene, Messages const& messages) {
  auto const& model = scene.model();
  for (auto const& warning : warnings_of(scene)) messages.warning(warning);
  for (auto const& remark : remarks_of(model)) messages.remark(remark);
  if (auto const& remark = model.lean.remark; !remark.empty()) {
    messages.eio(
        fmt::format("! <GPU Shading Lean Input>, Surfaces Left Out, Remark\n"
                    "GPU Shading Lean Input,{},{}\n",
                    model.lean.left_out.size(), remark));
  }
  describe_surroundings(model.surroundings, messages);
  list_transmitting_surfaces(scene, messages);
}

std::string describe_errors(AnswerErrors const& errors) {
  std::vector<std::string> parts;
  if (errors.sampled() > 0) {
    parts.push_back(fmt::format("99 % of {} sampled views within {:.2g}, all within {:.2g}",
                                errors.sampled(), errors.within(most_views), errors.largest()));
  }
  if (errors.not_measured() > 0) {
    parts.push_back(fmt::format("{} views not measured", errors.not_measured()));
  }
  parts.push_back(fmt::format("{} views exact, within {:.0e}", errors.exact(), Sunlit::rounding));
  return fmt::format("{}", fmt::join(parts, "; "));
}

void describe_answers(SunQuestions const& answers, AnswerErrors const& errors,
                      Options const& options, Messages const& messages) {
  auto const& rendered = answers.rendered();
  auto const& device = rendered.renderer().device();
  auto const& scene = rendered.renderer().scene();
  auto const counts = answers.counts();
  std::size_t casters = 0;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].casting != Casting::never) ++casters;
  }
  list_errors(errors, options, messages);
  warn_of_missed_targets(answers, errors, options, messages);
  warn_of_uncertain_receivers(answers, errors, messages);
  auto const from_cache =
      rendered.has_cache() ? fmt::format(" rendered, {} from the cache", counts.recalled) : "";
  auto const asked = std::ranges::count(answers.asked(), true);
  auto const& did = counts.rendering;
  messages.remark(fmt::format(
      "shading rendered by {}, {}: {} receivers, {} casters, {} directions{}, {} "
      "views drawn, {} clear, {:.2f} s; errors: {}",
      describe(device), describe_fineness(options), asked, casters, counts.directions, from_cache,
      did.receivers_drawn, did.receivers_clear, did.seconds, describe_errors(errors)));
  if (auto const& sampled = answers.sampled()) {
    messages.remark(fmt::format(
        "{} directions of the sun answered from samples at {}, --gpu-shading-update {}{}",
        sampled->answered(), sampled->sampled(), name_of(options.update),
        describe_expected_error(sampled->expected_error(), *options.update.sampling)));
  }
}

void warn_of_ground_light(
    Scene const& surfaces, RunRecord const& record,
    std::function<std::vector<double>(std::vector<SurfaceId> const&)> const& ratios,
    Messages const& messages) {
  constexpr double negligible = 0.1;
  std::vector<std::pair<double, SurfaceId>> shares;
  for (std::size_t i = 0; i < record.receivers().size(); ++i) {
    auto const& light = record.light()[i];
    double const ground = light.of_run(ReceivedLight::by_ground);
    double const all =
        light.of_run(ReceivedLight::beam) + light.of_run(ReceivedLight::sky) + ground;
    if (ground > negligible * all) shares.emplace_back(ground / all, record.receivers()[i]);
  }
  if (shares.empty()) return;
  std::ranges::stable_sort(shares, std::greater{}, &std::pair<double, SurfaceId>::first);
  constexpr std::size_t max_listed = 3;
  std::vector<SurfaceId> worst;
  for (std::size_t i = 0; i < std::min(max_listed, shares.size()); ++i) {
    worst.push_back(shares[i].second);
  }
  auto const of_worst = ratios(worst);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    auto const& [share, id] = shares[i];
    auto const much = i < worst.size() ? describe_ratio(of_worst[i]) : "";
    names.push_back(fmt::format("{} ({:.0f} %{})", surfaces[id].name, 100.0 * share, much));
  }
  messages.warning(fmt::format(
      "light from the ground that no GPUShading object dims is over 10 % of the beam, sky and "
      "ground light on {} surface{}: {}; see --gpu-shading-reflections",
      names.size(), names.size() == 1 ? "" : "s", listed(names, max_listed)));
}

}  // namespace gpu_shading::energyplus
