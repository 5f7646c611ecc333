#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/listed_folder.h"
#include "programs/gpu_shading/map_files.h"
#include "programs/gpu_shading/run_period.h"
#include "runs/installation.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;

struct MapOrder {
  DayOptions days;
  std::string receivers;  // a pattern of names; empty: all that EnergyPlus shades
  double spacing = 0.25;  // m
  int rays_per_cell = 4;
  bool common_scale = false;  // of the pictures; otherwise each has its own
  std::filesystem::path folder;
};

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
MapValue largest_of(std::vector<GriddedMap> const& maps) {
  MapValue largest;
  for (auto const& one : maps) {
    largest.hours = std::max(largest.hours, one.summary.largest.hours);
    largest.energy = std::max(largest.energy, one.summary.largest.energy);
  }
  return largest;
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
  auto const largest = largest_of(maps);
  for (auto const& [map, grid, summary] : maps) {
    auto const name = summary.stem + ".png";
    auto const picture = try_drawing(name, heading_of(summary, period), grid, map.values,
                                     scales_for(common_scale ? largest : summary.largest));
    if (!picture) return;
    folder.write(name, *picture);
  }
}

// Traces and writes maps of sunlit hours and beam energy: for each receiver a picture, a table and
// an array, and for all of them maps.csv, and maps.json about the run.
void draw_maps(ModelRun const& run, MapOrder const& order) {
  auto const site = read_weather_site(weather_of(run));
  require_model(run.model);
  auto const period = period_of(order.days);
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
  print("{}\n", (order.folder / "maps.csv").string());
}

}  // namespace

void add_map(Program const& program) {
  Command const command(
      program, "map",
      "Map the sunlit hours and the beam solar energy over receivers, at the model's own timesteps "
      "and with its schedules: for each receiver a picture, a table and a NumPy array, and a list "
      "of all (maps.csv)",
      model_options());
  auto const model =
      command.add_model("Weather file: site, calendar and beam radiation (required)");
  auto const order = std::make_shared<MapOrder>();
  add_days(*command.operator->(), order->days);
  command.add_receivers(
      "--receivers", order->receivers,
      "; also of shading surfaces (default: all surfaces that EnergyPlus shades)");
  command.add_spacing("--spacing", order->spacing, "Largest side of a cell, m")
      ->capture_default_str();
  constexpr int max_rays = 100;
  command
      ->add_option("--rays", order->rays_per_cell,
                   "Rays from each cell to each position of the sun")
      ->check(CLI::Range(1, max_rays))
      ->capture_default_str()
      ->type_name("N");
  command->add_flag(
      "--common-scale", order->common_scale,
      "One colour scale for the pictures of all receivers; otherwise each has its own");
  command.add_folder(order->folder, "maps");
  command.run([model, order] { draw_maps(*model, *order); });
}

}  // namespace gpu_shading::energyplus
