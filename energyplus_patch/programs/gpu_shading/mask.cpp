#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/site_clock.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/listed_folder.h"
#include "programs/gpu_shading/mask_files.h"
#include "reports/report.h"
#include "runs/installation.h"
#include "runs/short_runs.h"
#include "tasks/samples/year_table.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;

struct MaskOrder {
  std::string receivers;
  std::string projection = "stereographic";
  int step = 2;   // degrees
  int rays = 32;  // from a receiver in each direction
  double spacing = 0.0;
  double beam = 300.0;            // W/m2
  std::filesystem::path samples;  // a folder, or empty
  std::filesystem::path folder;
};

constexpr int months = 12;
constexpr int hours_of_day = 24;

using MeanBeams = std::map<std::pair<int, int>, double>;  // by month and hour

// The mean of each month of the weather file at each full hour.
MeanBeams mean_beams(ModelRun const& run) {
  EnergyPlusCall call;
  call.program = find_launcher();
  call.model = run.model;
  call.weather = run.weather;
  auto const times = run_for_beam(call, {});
  std::map<std::pair<int, int>, std::pair<double, int>> sums;
  for (auto const& time : times.times) {
    if (time.timestep != times.steps_per_hour) continue;
    auto& [sum, count] = sums[{time.month, time.hour % hours_of_day}];
    sum += time.beam;
    ++count;
  }
  MeanBeams means;
  for (auto const& [when, sum] : sums) means[when] = sum.first / sum.second;
  return means;
}

MaskSite site_of(ModelRun const& run, MaskOrder const& order) {
  auto const place =
      run.weather ? read_weather_site(*run.weather) : read_site(read_objects(run.model));
  auto const means = run.weather ? mean_beams(run) : MeanBeams();
  MaskSite site{place.name,
                place.latitude,
                place.longitude,
                place.time_zone,
                fmt::format("beam {:g} W/m2 or more ({})", order.beam,
                            run.weather ? "month's mean of the EPW" : "ASHRAE's clear sky"),
                {}};
  for (int month = 1; month <= months; ++month) {
    for (int hour = 0; hour < hours_of_day; ++hour) {
      auto const sun = site.sun(day_21_of(month), hour);
      if (!sun_is_up(sun)) continue;
      auto const mean = means.find({month, hour});
      double const beam = !run.weather          ? clear_sky_beam(month, sun.altitude)
                          : mean == means.end() ? 0.0
                                                : mean->second;
      site.hours.push_back({month, hour, sun, beam, beam >= order.beam});
    }
  }
  return site;
}

std::vector<ReceiverMask> trace(ModelRun const& run, MaskOrder const& order, MaskSite const& site) {
  StandardError const progress;
  TemporaryFolder const temporary;
  MaskTask task{order.receivers,      order.step, order.rays,
                order.spacing,        {},         temporary.path() / "masks",
                progress.descriptor()};
  for (auto const& hour : site.hours) task.suns.push_back(hour.sun);
  auto const reply = run_task(run, task);
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  print_line(reply.text);
  return read_masks(task.file);
}

// The sunlit fractions of the site's hours from year.csv of a folder of samples.
void take_samples(std::filesystem::path const& folder, MaskSite const& site,
                  std::vector<ReceiverMask>& masks) {
  auto const file = folder / year_file;
  naming(file.string(), [&] {
    std::ifstream csv(file, std::ios::binary);
    auto const sampled = read_hours_of_21st(csv);
    for (std::size_t i = 0; i < site.hours.size(); ++i) {
      MaskHour const& wanted = site.hours[i];
      auto const found = std::ranges::find_if(sampled.hours, [&](SampledHour const& one) {
        return one.month == wanted.month && one.hour == wanted.hour;
      });
      // The sun of the 21st moves by up to half a degree from year to year.
      constexpr double same_sun = 0.02;  // radians
      if (found == sampled.hours.end() ||
          glm::distance(to_vector(found->sun), to_vector(wanted.sun)) > same_sun) {
        throw Error(fmt::format("has no sun at {:02}-21 {:02}:00 as at {}: of another site?",
                                wanted.month, wanted.hour, site.name));
      }
      for (auto& mask : masks) {
        auto const column = std::ranges::find(sampled.receivers, csv_field(mask.receiver.name));
        if (column == sampled.receivers.end()) {
          throw Error(fmt::format("has no receiver {}: of another model?", mask.receiver.name));
        }
        set_sunlit(mask.suns[i],
                   found->fractions[static_cast<std::size_t>(column - sampled.receivers.begin())]);
      }
    }
  });
}

std::vector<MaskSummary> summarise(std::vector<ReceiverMask> const& masks, SkyGrid const& grid) {
  FileNames names;
  std::map<std::string, int> points;
  std::vector<MaskSummary> summaries;
  for (auto const& mask : masks) {
    auto const normal = glm::normalize(mask.receiver.area);
    auto title = mask.receiver.name;
    if (mask.point) title += fmt::format(", point {}", ++points[title]);
    auto const [azimuth, tilt] = facing_of(normal);
    summaries.push_back(
        {title, names.add(title, ""), azimuth, tilt, sky_view(grid, mask.sky, normal)});
  }
  return summaries;
}

Projection projection_of(std::string const& name) {
  return name == "cylindrical"   ? Projection::cylindrical
         : name == "equidistant" ? Projection::equidistant
                                 : Projection::stereographic;
}

void write_pictures(std::vector<ReceiverMask> const& masks,
                    std::vector<MaskSummary> const& summaries, SkyGrid const& grid,
                    MaskSite const& site, Projection projection, ListedFolder& folder) {
  bool images = true;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    auto const& summary = summaries[i];
    auto const figure = draw_mask(masks[i], summary, grid, site, projection);
    auto const description =
        fmt::format("Shading mask with the sun's paths. Sky view factor {:.3f}, unshaded {:.3f}.",
                    summary.view.view, summary.view.unshaded);
    folder.write(summary.stem + ".svg", [&](std::ostream& out) {
      figure.write_svg(printable(summary.title), description, out);
    });
    if (!images) continue;
    try {
      auto const name = summary.stem + ".png";
      folder.write(name, figure.encode(name));
    } catch (Error const& error) {
      // Installations without the picture formats have the rest.
      print_line(fmt::format("warning: no .png pictures: {}", error.what()));
      images = false;
    }
  }
}

void draw_masks(ModelRun const& run, MaskOrder const& order) {
  require_model(run.model);
  if (!order.samples.empty()) require_file(order.samples / year_file);
  ListedFolder folder(order.folder, "masks.json", "gpu_shading masks 1");
  auto const site = site_of(run, order);
  SkyGrid const grid(order.step);
  auto masks = trace(run, order, site);
  if (!order.samples.empty()) take_samples(order.samples, site, masks);
  auto const summaries = summarise(masks, grid);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    folder.write(summaries[i].stem + ".csv",
                 [&](std::ostream& out) { write_sky(masks[i], grid, out); });
    folder.write(summaries[i].stem + ".hor",
                 [&](std::ostream& out) { write_horizon(masks[i], grid, out); });
  }
  write_pictures(masks, summaries, grid, site, projection_of(order.projection), folder);
  folder.write("hours.csv", [&](std::ostream& out) { write_hours(masks, summaries, site, out); });
  folder.write("masks.csv", [&](std::ostream& out) { write_summaries(masks, summaries, out); });
  folder.commit(
      Json{{"versions",
            {{"gpu_shading", GPU_SHADING_VERSION}, {"energyplus", read_version(own_folder())}}},
           {"model", run.model.filename().string()},
           {"weather", run.weather ? Json(run.weather->filename().string()) : Json()},
           {"site",
            {{"name", site.name},
             {"latitude", site.latitude},
             {"longitude", site.longitude},
             {"time_zone", site.time_zone}}},
           {"step", order.step},
           {"rays", order.rays},
           {"marked", site.beam},
           {"projection", order.projection}});
  print("{}\n", (order.folder / "masks.csv").string());
}

}  // namespace

void add_mask(Program const& program) {
  Command const command(
      program, "mask",
      "Draw shading masks: for each window a diagram of the sky with what shades the window, the "
      "sun's paths coloured by sunlit fraction, and the sky view factor; as .png, .svg and .csv, "
      "with the horizon as a .hor file, hours.csv and masks.csv. Transmittance schedules are at "
      "their lowest value, and screens fully deployed",
      model_options({"cache", "cache-size", "cache-read-only"}));
  auto const model = command.add_model(
      "Weather file: site and mean beam of the hours (default: Site:Location and a clear sky)");
  auto const order = std::make_shared<MaskOrder>();
  command.add_receivers("--receiver", order->receivers,
                        " (default: all windows, or all receivers without windows)");
  command
      ->add_option("--projection", order->projection,
                   "Projection of the sky: around the zenith, or a cylinder as in PVsyst")
      ->check(CLI::IsMember({"stereographic", "equidistant", "cylindrical"}))
      ->capture_default_str();
  command->add_option("--step", order->step, "Step of azimuth and altitude in the sky, degrees")
      ->check(CLI::IsMember({1, 2, 3, 5, 6, 9, 10}))
      ->capture_default_str()
      ->type_name("DEG");
  constexpr int max_rays = 1000;
  command->add_option("--rays", order->rays, "Rays from a receiver in each direction")
      ->check(CLI::Range(1, max_rays))
      ->capture_default_str()
      ->type_name("N");
  auto* const points = command.add_spacing(
      "--points", order->spacing,
      "Instead of whole receivers: masks of the points of a grid with this spacing, m");
  command
      ->add_option("--samples", order->samples,
                   "Folder of gpu_shading sample, whose sunlit fractions the hours have, with "
                   "schedules")
      ->excludes(points)
      ->type_name("DIR");
  constexpr double max_beam = 1400.0;
  command
      ->add_option("--beam", order->beam,
                   "Mark hours with this direct normal irradiance or more, W/m2")
      ->check(CLI::Range(0.0, max_beam))
      ->capture_default_str()
      ->type_name("W/m2");
  command.add_folder(order->folder, "masks");
  command.run([model, order] { draw_masks(*model, *order); });
}

}  // namespace gpu_shading::energyplus
