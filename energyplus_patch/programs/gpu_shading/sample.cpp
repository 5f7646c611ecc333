#include "programs/gpu_shading/sample.h"

#include <fmt/format.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "model/model_reader.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "programs/gpu_shading/standard_error.h"
#include "routes/schedules/rendered_fractions.h"
#include "runs/installation.h"
#include "runs/short_runs.h"
#include "scene/digest.h"
#include "tasks/samples/sample_set.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;
using Json = nlohmann::ordered_json;

constexpr int steps_per_hour = 4;

std::string hash_of(Path const& file) {
  Digest digest;
  digest.add(std::string_view(read_text_file(file)));
  return to_text(digest.result());
}

// The model and site to sample.
struct Source {
  ModelRun const& run;
  Path weather;
  WeatherSite site;
  Sampling sampling;
  std::string mode;
  std::string model_hash;
  std::optional<Path> extensions;
  std::string extensions_hash;

  double latitude() const { return glm::radians(site.latitude); }
  std::string asked() const {
    return fmt::format("{} samples at latitude {} of model {}, extensions {}", mode, site.latitude,
                       model_hash, extensions ? extensions_hash : "none");
  }
};

Source read_source(ModelRun const& run) {
  if (!run.weather) {
    throw Error("-w: a weather file is required (it sets site and calendar)");
  }
  constexpr std::string_view prefix = "sampled:";
  auto const& update = run.choices.update.value();
  Source source{run,
                *run.weather,
                read_weather_site(*run.weather),
                update.sampling.value(),
                name_of(update).substr(prefix.size()),
                hash_of(run.model),
                find_side_file(run.model, run.choices),
                ""};
  if (source.extensions) source.extensions_hash = hash_of(*source.extensions);
  return source;
}

std::string render(Source const& source, Path const& parts, Shard const& shard) {
  StandardError const progress;
  SamplesTask const task{source.asked(), source.latitude(), std::filesystem::absolute(parts), shard,
                         progress.descriptor()};
  auto const reply = run_task(source.run, task);
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  return reply.text;
}

Json describe_file(Path const& file, std::string const& hash) {
  return {{"name", file.filename().string()}, {"xxh128", hash}};
}

Json describe(Source const& source, SampleSet const& set, RunTimes const& year) {
  auto const& site = source.site;
  Json json{{"format", "gpu_shading samples 1"},
            {"versions",
             {{"gpu_shading", GPU_SHADING_VERSION}, {"energyplus", read_version(own_folder())}}},
            {"mode", source.mode},
            {"fineness", set.scene.fineness},
            {"devices", set.devices},
            {"site",
             {{"name", site.name},
              {"latitude", site.latitude},
              {"longitude", site.longitude},
              {"time_zone", site.time_zone},
              {"elevation", site.elevation}}},
            {"inputs",
             {{"model", describe_file(source.run.model, source.model_hash)},
              {"weather", describe_file(source.weather, hash_of(source.weather))}}},
            {"scene", set.scene.hash},
            {"directions", set.samples.directions().size()},
            {"directions_by_round", set.rounds},
            {"year", {{"rows", year.times.size()}, {"rows_per_hour", year.steps_per_hour}}},
            {"schedules", set.scene.schedules},
            {"receivers", Json::array()}};
  if (source.extensions) {
    json["inputs"]["extensions"] = describe_file(*source.extensions, source.extensions_hash);
  }
  auto const& errors = set.samples.expected_errors();
  for (std::size_t i = 0; i < set.scene.receivers.size(); ++i) {
    auto const& [name, area] = set.scene.receivers[i];
    auto const normal = glm::normalize(area);
    json["receivers"].push_back(
        {{"name", name}, {"area", glm::length(area)}, {"normal", {normal.x, normal.y, normal.z}}});
    if (i < errors.size()) json["receivers"].back()["expected_error"] = errors[i];
  }
  return json;
}

RunTimes run_year(Source const& source, SampleSet const& set) {
  EnergyPlusCall call;
  call.program = find_launcher();
  call.model = source.run.model;
  call.weather = source.weather;
  auto year = run_for_year(call, set.scene.schedules, steps_per_hour);
  if (set.scene.schedules.empty()) return year;
  auto const unknown =
      unknown_schedules(read_model(source.run.model, source.run.choices), year.schedules);
  if (!unknown.empty()) print_line("warning: " + describe_unknown(unknown));
  return year;
}

void put_together(Source const& source, SampleParts const& parts, Path const& folder) {
  auto const set = gather_samples(parts, source.asked(), source.sampling, source.latitude());
  auto const year = run_year(source, set);
  auto const write = [&](std::string_view name, auto const& content) {
    write_whole_file(folder / name, content);
    print("{}\n", (folder / name).string());
  };
  write("samples.csv", [&](std::ostream& out) { write_samples(set, out); });
  write("year.csv", [&](std::ostream& out) { write_year(set, year, out); });
  write("samples.json",
        [&](std::ostream& out) { out << describe(source, set, year).dump(2) << '\n'; });
  print_line(fmt::format("{} directions of {} receivers, {} times of the year",
                         set.samples.directions().size(), set.scene.receivers.size(),
                         year.times.size()));
}

}  // namespace

void sample(ModelRun const& run, SampleTask const& task) {
  auto const source = read_source(run);
  auto const folder = task.folder / "parts";
  if (task.shard) {
    print_line(render(source, folder, *task.shard));
    return;
  }
  if (!task.merge) print_line(render(source, folder, {}));
  put_together(source, SampleParts(folder, task.merge.value_or(1)), task.folder);
}

}  // namespace gpu_shading::energyplus
