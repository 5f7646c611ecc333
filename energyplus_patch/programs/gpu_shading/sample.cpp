#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "model/model_reader.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "routes/schedules/rendered_run.h"
#include "runs/installation.h"
#include "runs/short_runs.h"
#include "scene/digest.h"
#include "tasks/samples/sample_parts.h"
#include "tasks/samples/sample_set.h"
#include "tasks/samples/year_table.h"

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
    return fmt::format("{} samples at latitude {} of model {}, extensions {}{}", mode,
                       site.latitude, model_hash, extensions ? extensions_hash : "none",
                       run.choices.positions ? ", positions " + *run.choices.positions : "");
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

std::string render(Source const& source, Path const& parts, Shard const& shard, double wait) {
  StandardError const progress;
  SamplesTask const task{source.asked(), source.latitude(),     std::filesystem::absolute(parts),
                         shard,          progress.descriptor(), wait};
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
  if (auto const& positions = source.run.choices.positions) json["positions"] = *positions;
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
  auto const model = read_model(source.run.model, source.run.choices);
  if (auto const warning = warn_of_actuated(model)) print_line("warning: " + *warning);
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
  write(year_file, [&](std::ostream& out) { write_year(set, year, out); });
  write("samples.json",
        [&](std::ostream& out) { out << describe(source, set, year).dump(2) << '\n'; });
  print_line(fmt::format("{} directions of {} receivers, {} times of the year",
                         set.samples.directions().size(), set.scene.receivers.size(),
                         year.times.size()));
}

struct SampleOrder {
  std::string mode = "medium";
  std::string folder;
  std::string shard;  // "3/8": render one share of one round; do not write tables
  double wait = 0.0;  // s
  int merge = 0;      // write tables from the parts of this many shards; do not render
  bool sky = false;
};

// "3/8".
Shard parse_shard(std::string const& text) {
  auto const slash = text.find('/');
  auto const number = parse_number(text.substr(0, slash));
  auto const shards = parse_number(slash == std::string::npos ? "" : text.substr(slash + 1));
  constexpr double max_shards = 10000.0;
  bool const whole =
      number && shards && std::floor(*number) == *number && std::floor(*shards) == *shards;
  if (!whole || *number < 1.0 || *number > *shards || *shards > max_shards) {
    throw Error(fmt::format("--shard {}: expected I/N, the I-th of N shards, such as 3/8", text));
  }
  return {static_cast<int>(*number), static_cast<int>(*shards)};
}

// "Louvres=40,Awning=0.5" for every combination of the positions of moving shades; empty without
// any.
std::vector<std::string> all_positions(ModelRun const& run) {
  auto const shades = read_model(run.model, run.choices).moving_shades;
  if (shades.empty()) return {};
  std::vector<std::string> all{""};
  for (auto const& shade : shades) {
    std::vector<std::string> longer;
    for (auto const& before : all) {
      for (double const position : shade.positions()) {
        longer.push_back(
            fmt::format("{}{}{}={:.9g}", before, before.empty() ? "" : ",", shade.name, position));
      }
    }
    all = std::move(longer);
    constexpr std::size_t max_positions = 100;
    if (all.size() <= max_positions) continue;
    throw Error(
        fmt::format("{}: {} or more positions to sample, expected at most {}: name positions by "
                    "--gpu-shading-positions, or use a larger Step",
                    shade.where, all.size(), max_positions));
  }
  return all;
}

// Renders the samples that --gpu-shading-update sampled:... uses, without a year's run, and writes
// samples.csv, year.csv and, last, samples.json, each completely or not at all; rendered parts are
// in parts/.
void sample_into(std::filesystem::path const& folder, ModelRun const& run,
                 SampleOrder const& order) {
  auto const source = read_source(run);
  if (!order.shard.empty()) {
    print_line(render(source, folder / "parts", parse_shard(order.shard), order.wait));
    return;
  }
  if (order.merge == 0) print_line(render(source, folder / "parts", {}, 0.0));
  put_together(source, SampleParts(folder / "parts", std::max(order.merge, 1)), folder);
}

void sample(ModelRun run, SampleOrder const& order) {
  std::vector<std::string> flags{"--gpu-shading-update=sampled:" + order.mode};
  run.choices.update = take_flags(flags).update;
  run.choices.paper_grid = false;
  std::vector<std::string> positions;
  if (!run.choices.positions) positions = all_positions(run);
  if (positions.empty()) sample_into(order.folder, run, order);
  FileNames names;
  for (auto const& each : positions) {
    run.choices.positions = each;
    print_line(each);
    sample_into(Path(order.folder) / names.add(each, ""), run, order);
  }
}

}  // namespace

void add_sample(Program const& program) {
  Command const command(
      program, "sample",
      "Sample sunlit fractions as --gpu-shading-update sampled:... does, without a run, and write "
      "tables of the samples and of every 15 minutes of the year; or sunlit fractions for patches "
      "of the sky",
      model_options({"cache", "cache-size", "cache-read-only"}));
  auto const model =
      command.add_model("Weather file: site and calendar (required, except with --sky)");
  auto const order = std::make_shared<SampleOrder>();
  command
      ->add_option("-o,--output", order->folder,
                   "Folder for samples.csv and year.csv, or for sky.csv and sky_view.csv")
      ->required()
      ->check(folder_name())
      ->type_name("DIR");
  auto* const mode = command->add_option("--mode", order->mode, "Density of the samples");
  mode->check(CLI::IsMember({"fine", "medium", "coarse"}))->capture_default_str();
  auto* const shard = command->add_option(
      "--shard", order->shard,
      "Render the I-th of N shares of one round and keep it in the folder; repeat for all shares, "
      "then for the next round, until all rounds are complete");
  shard->type_name("I/N");
  command
      ->add_option("--wait", order->wait,
                   "With --shard: after each round, seconds to wait for the other shares and go on")
      ->check(CLI::Range(0.0, 86400.0))
      ->needs(shard);
  constexpr int max_shards = 10000;
  auto* const merge = command->add_option(
      "--merge", order->merge,
      "Write the tables from the parts that N shards have rendered; render nothing");
  merge->check(CLI::Range(1, max_shards))->excludes(shard)->type_name("N");
  command
      ->add_flag("--sky", order->sky,
                 "Instead, for the patches of EnergyPlus's, Tregenza's and Reinhart's skies, with "
                 "view factors to the sky; transmittance schedules are at their lowest value and "
                 "screens fully deployed")
      ->excludes(mode, shard, merge);
  command.run([model, order] {
    if (order->sky) {
      sample_sky(*model, order->folder);
    } else {
      sample(*model, *order);
    }
  });
}

}  // namespace gpu_shading::energyplus
