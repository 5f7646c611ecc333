#include "programs/gpu_shading/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/model_reader.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/listed_folder.h"
#include "programs/gpu_shading/map_picture.h"
#include "programs/gpu_shading/map_tables.h"
#include "programs/gpu_shading/standard_error.h"
#include "reports/map_file.h"
#include "routes/schedules/rendered_fractions.h"
#include "runs/installation.h"
#include "runs/short_runs.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;

constexpr int months_apart = 100;  // of the numbers of days

// Days by number, 100 x month + day, in any year.
struct Period {
  int from;
  int to;  // may be less: then across the new year

  bool has(RunTime const& time) const {
    int const day = months_apart * time.month + time.day;
    return from <= to ? from <= day && day <= to : day >= from || day <= to;
  }
};

int parse_day(char const* option, std::string const& text) {
  static std::regex const form(R"((\d\d?)-(\d\d?))");
  std::smatch words;
  if (std::regex_match(text, words, form)) {
    constexpr int leap_year = 2024;
    auto const date = std::chrono::year(leap_year) / std::stoi(words[1]) / std::stoi(words[2]);
    if (date.ok()) return months_apart * std::stoi(words[1]) + std::stoi(words[2]);
  }
  throw Error(fmt::format("{} {}: expected month and day, as in 06-21", option, in_quotes(text)));
}

std::string day_text(int number) {
  return fmt::format("{:02}-{:02}", number / months_apart, number % months_apart);
}

std::string describe_days(Period const& period) {
  if (period.from == period.to) return day_text(period.from);
  return fmt::format("{} to {}", day_text(period.from), day_text(period.to));
}

Period period_of(MapOrder const& order) {
  constexpr int first = 101;
  constexpr int last = 1231;
  return {order.from.empty() ? first : parse_day("--from", order.from),
          order.to.empty() ? last : parse_day("--to", order.to)};
}

// The times of the period with the sun up, from a run of EnergyPlus with nothing but calendar,
// weather and schedules: a second or two for a year of any model. The run that traces cannot tell
// them: it ends at its first question about shading, before any weather, and without that end it
// would simulate the building for the whole year. The model is read here for the names of the
// schedules, which EnergyPlus only reports if it is asked for them by name.
RunTimes times_of(ModelRun const& run, Period const& period) {
  EnergyPlusCall call;
  call.program = find_launcher();
  call.model = run.model;
  call.weather = run.weather;
  auto const model = read_model(run.model, run.choices);
  auto times = run_for_beam(call, shade_schedules(model));
  auto const unknown = unknown_schedules(model, times);
  if (!unknown.empty()) print_line("warning: " + describe_unknown(unknown));
  std::erase_if(times.times,
                [&](RunTime const& time) { return !period.has(time) || !sun_is_up(time.sun); });
  if (times.times.empty()) {
    throw Error(fmt::format("--from {} --to {}: the sun does not rise in the weather file's days",
                            day_text(period.from), day_text(period.to)));
  }
  return times;
}

std::vector<ReceiverMap> trace(ModelRun const& run, MapOrder const& order, RunTimes times) {
  StandardError const progress;
  TemporaryFolder const temporary;
  auto const file = temporary.path() / "maps";
  auto const reply = run_task(run, MapTask{order.receivers, order.spacing, order.rays_per_cell,
                                           std::move(times), file, progress.descriptor()});
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  print_line(reply.text);
  return read_maps(file);
}

struct GriddedMap {
  ReceiverMap map;
  MapGrid grid;
  MapSummary summary;
};

std::vector<GriddedMap> grid_maps(std::vector<ReceiverMap> maps, double spacing) {
  FileNames names;
  std::vector<GriddedMap> gridded;
  for (auto& map : maps) {
    MapGrid grid(map.polygon, spacing);
    auto summary = summarise(grid, map.values);
    summary.receiver = map.name;
    summary.stem = names.add(map.name, "");
    gridded.push_back({std::move(map), std::move(grid), std::move(summary)});
  }
  return gridded;
}

// The largest values of all receivers.
MapValue most_of(std::vector<GriddedMap> const& maps) {
  MapValue most;
  for (auto const& one : maps) {
    most.hours = std::max(most.hours, one.summary.most.hours);
    most.energy = std::max(most.energy, one.summary.most.energy);
  }
  return most;
}

std::string orientation(MapSummary const& summary) {
  constexpr double level = 0.5;  // degrees
  constexpr double half_turn = 180.0;
  if (summary.tilt < level) return "faces up, seen from above";
  if (summary.tilt > half_turn - level) return "faces down, seen from below";
  return fmt::format("faces {}, tilt {:.0f} degrees, seen from outside",
                     describe_azimuth(summary.azimuth), summary.tilt);
}

MapHeading heading_of(MapSummary const& summary, std::string const& period) {
  return {printable(summary.receiver),
          {fmt::format("{:.4g} m2, {}", summary.area, orientation(summary)),
           fmt::format("{}, cells {:.3g} m x {:.3g} m", period, summary.cell_width,
                       summary.cell_height)}};
}

Json describe_maps(ModelRun const& run, MapOrder const& order, Period const& period,
                   RunTimes const& times, WeatherSite const& site) {
  return {
      {"versions",
       {{"gpu_shading", GPU_SHADING_VERSION}, {"energyplus", read_version(own_folder())}}},
      {"model", run.model.filename().string()},
      {"weather", run.weather->filename().string()},
      {"site", {{"name", site.name}, {"latitude", site.latitude}, {"longitude", site.longitude}}},
      {"from", day_text(period.from)},
      {"to", day_text(period.to)},
      {"times_with_sun", times.times.size()},
      {"steps_per_hour", times.steps_per_hour},
      {"spacing", order.spacing},
      {"rays_per_cell", order.rays_per_cell}};
}

// Installations without the picture formats have the tables.
std::optional<std::string> try_drawing(std::string const& name, MapHeading const& heading,
                                       MapGrid const& grid, std::vector<MapValue> const& values,
                                       MapScales const& scales) {
  try {
    return draw_map(name, heading, grid, values, scales);
  } catch (Error const& error) {
    print_line(fmt::format("warning: no pictures: {}", error.what()));
    return std::nullopt;
  }
}

void write_pictures(std::vector<GriddedMap> const& maps, std::string const& period,
                    bool common_scale, ListedFolder& folder) {
  auto const most = most_of(maps);
  for (auto const& [map, grid, summary] : maps) {
    auto const name = summary.stem + ".png";
    auto const picture = try_drawing(name, heading_of(summary, period), grid, map.values,
                                     scales_for(common_scale ? most : summary.most));
    if (!picture) return;
    folder.write(name, *picture);
  }
}

}  // namespace

void draw_maps(ModelRun const& run, MapOrder const& order) {
  if (!run.weather) {
    throw Error("-w: a weather file is required (it sets site, calendar and beam radiation)");
  }
  require_model(run.model);
  auto const site = read_weather_site(*run.weather);
  auto const period = period_of(order);
  ListedFolder folder(order.folder, "maps.json", "gpu_shading maps 1");
  auto times = times_of(run, period);
  auto const about = describe_maps(run, order, period, times, site);
  auto const steps = times.steps_per_hour;
  auto const maps = grid_maps(trace(run, order, std::move(times)), order.spacing);
  std::vector<MapSummary> summaries;
  for (auto const& one : maps) {
    auto const& stem = one.summary.stem;
    folder.write(stem + ".csv",
                 [&](std::ostream& out) { write_cells(one.grid, one.map.values, out); });
    folder.write(stem + ".npy",
                 [&](std::ostream& out) { write_array(one.grid, one.map.values, out); });
    summaries.push_back(one.summary);
  }
  auto const dates = fmt::format("{}, {} times an hour", describe_days(period), steps);
  write_pictures(maps, dates, order.common_scale, folder);
  folder.write("maps.csv", [&](std::ostream& out) { write_summaries(summaries, out); });
  folder.commit(about);
  print_text(fmt::format("{}\n", (order.folder / "maps.csv").string()));
}

}  // namespace gpu_shading::energyplus
