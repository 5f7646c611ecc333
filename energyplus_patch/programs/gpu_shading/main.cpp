// gpu_shading: devices, checks, pictures, maps, screens, samples and exports.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "model/options/options.h"
#include "platform/console.h"
#include "platform/ending_signals.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/check_model.h"
#include "programs/gpu_shading/device_table.h"
#include "programs/gpu_shading/export.h"
#include "programs/gpu_shading/map.h"
#include "programs/gpu_shading/picture_files.h"
#include "programs/gpu_shading/sample.h"
#include "programs/gpu_shading/screen.h"
#include "programs/gpu_shading/sky.h"
#include "programs/gpu_shading/view_times.h"

namespace gpu_shading::energyplus {
namespace {

// Arguments of every subcommand that reads a model.
class ModelArguments {
 public:
  // `choices`: from the flags shared with energyplus; `weather`: what -w says of itself.
  ModelArguments(
      CLI::App& command, Choices choices,
      std::string const& weather = "Weather file (default: one that comes with EnergyPlus)")
      : choices_(std::move(choices)) {
    command.add_option("model", model_, "IDF or epJSON file")->required();
    command.add_option("-w,--weather", weather_, weather);
    command.footer(std::string(flags_help()));
  }

  ModelRun run() const {
    ModelRun run{model_, std::nullopt, choices_};
    if (!weather_.empty()) run.weather = weather_;
    if (run.weather && !std::filesystem::exists(*run.weather)) {
      throw Error(fmt::format("-w {}: no such file", weather_));
    }
    return run;
  }

 private:
  std::string model_;
  std::string weather_;
  Choices choices_;
};

// Sets `right` to whether all tested devices are.
void add_devices(CLI::App& app, bool& right) {
  auto* const command = app.add_subcommand(
      "devices", "List the devices that can render, with their numbers for --gpu-shading-device");
  auto const test = std::make_shared<bool>(false);
  command->add_flag("--test", *test,
                    "Test each device and the CPU on cases with known answers; print errors, times "
                    "and a verdict. The exit status is 1 if one is wrong");
  command->callback([test, &right] {
    if (*test) {
      right = test_devices();
    } else {
      list_devices();
    }
  });
}

void add_check(CLI::App& app, Choices const& choices) {
  auto* const command =
      app.add_subcommand("check",
                         "Read a model and its extension objects, and print how each surface takes "
                         "part in the shading calculation, or every error");
  auto const arguments = std::make_shared<ModelArguments>(*command, choices);
  auto const task = std::make_shared<ListingTask>();
  command->add_flag("--vertices", task->vertices, "Print the vertices of every surface instead");
  command->add_flag("--json", task->json,
                    "Print one JSON document; with --vertices, the scene that is rendered: "
                    "vertices, optics and rules of all surfaces");
  command->callback([arguments, task] { check(arguments->run(), *task); });
}

// Arguments of the subcommand "view" besides the model.
struct ViewArguments {
  std::string receiver;
  std::vector<double> sun;
  std::vector<double> camera;
  std::string at;
  std::string day;
  std::string list;
  std::string output;
  std::optional<int> size;
};

std::vector<SunTime> view_times(ModelRun const& model, ViewArguments const& arguments) {
  if (!arguments.sun.empty()) {
    return {{fmt::format("azimuth {:g}, altitude {:g}", arguments.sun[0], arguments.sun[1]),
             direction_of_degrees(arguments.sun[0], arguments.sun[1])}};
  }
  SiteClock const clock(read_objects(model.model), model.weather);
  if (!arguments.at.empty()) return {sun_time(arguments.at, clock)};
  // As many as fit on a page, or as an animation needs.
  std::chrono::minutes const step(is_animation(arguments.output) ? 15 : 60);
  return sun_times(arguments.day, clock, step);
}

std::optional<SunDirection> camera_of(ViewArguments const& arguments) {
  if (arguments.camera.empty()) return std::nullopt;
  if (!arguments.receiver.empty() || !arguments.list.empty()) {
    throw Error("--camera: draws the whole model; leave out --receiver and --list");
  }
  auto const [azimuth, altitude] = std::pair(arguments.camera[0], arguments.camera[1]);
  constexpr double zenith = 90.0;
  constexpr double circle = 360.0;
  if (!(altitude > 0.0 && altitude <= zenith && std::abs(azimuth) <= circle)) {
    throw Error(fmt::format(
        "--camera {},{}: expected an azimuth from -360 to 360 and an altitude above 0, up to 90",
        azimuth, altitude));
  }
  return direction_of_degrees(azimuth, altitude);
}

void run_view(ModelRun const& model, ViewArguments const& arguments) {
  std::filesystem::path const output = arguments.output;
  constexpr int usual = 800;
  if (!arguments.list.empty()) {
    draw(model, read_views(arguments.list), output, arguments.size.value_or(usual));
    return;
  }
  if (arguments.sun.empty() && arguments.at.empty() && arguments.day.empty()) {
    throw Error(
        "expected --at \"MM-DD HH:MM\", --day MM-DD, --sun AZIMUTH,ALTITUDE, or --list FILE");
  }
  auto const camera = camera_of(arguments);
  auto const title = camera ? model.model.filename().string() + ", " : "";
  std::vector<CaptionedView> views;
  for (auto const& time : view_times(model, arguments)) {
    views.push_back({{"", time.sun, arguments.receiver, camera}, title + time.caption});
  }
  constexpr int usual_of_many = 400;
  draw_together(model, views, output,
                arguments.size.value_or(views.size() > 1 ? usual_of_many : usual));
  for (auto const& view : views) {
    auto const sun = view.view.sun;
    print_text(fmt::format("{}: sun at azimuth {:.3f}, altitude {:.3f} degrees\n", view.caption,
                           glm::degrees(sun.azimuth), glm::degrees(sun.altitude)));
  }
}

void add_view(CLI::App& app, Choices const& choices) {
  auto* const command = app.add_subcommand(
      "view",
      "Draw the model as the sun sees it, with receivers coloured from dark blue to yellow by "
      "their sunlit fraction; or one receiver, with sunlit parts yellow, shaded parts blue, and "
      "parts behind transparent casters grey. Transmittance schedules are at their lowest value, "
      "and screens fully deployed");
  auto const model = std::make_shared<ModelArguments>(*command, choices);
  auto const arguments = std::make_shared<ViewArguments>();
  command->add_option("--receiver", arguments->receiver, "Name of the receiver to draw");
  auto* const when = command->add_option_group("sun");
  when->add_option("--at", arguments->at,
                   "Month, day and clock time at Site:Location, with daylight saving if the model "
                   "has it, as in \"06-21 15:00\"")
      ->type_name("\"MM-DD HH:MM\"");
  when->add_option("--day", arguments->day,
                   "The hours of a day from sunrise to sunset in one picture; an animation in "
                   "steps of 15 minutes if the picture's name ends in .gif")
      ->type_name("MM-DD");
  when->add_option("--sun", arguments->sun,
                   "Azimuth clockwise from true north and altitude above the horizon, in degrees")
      ->delimiter(',')
      ->expected(2)
      ->type_name("AZIMUTH,ALTITUDE");
  when->add_option("--list", arguments->list,
                   "A file that lists pictures to draw without captions, one per line: PICTURE "
                   "AZIMUTH ALTITUDE [RECEIVER]");
  when->require_option(0, 1);
  command
      ->add_option(
          "--camera", arguments->camera,
          "Draw the model with its shadows as seen from here instead of from the sun, with "
          "north and a scale: azimuth clockwise from true north and altitude, in degrees")
      ->delimiter(',')
      ->expected(2)
      ->type_name("AZIMUTH,ALTITUDE");
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture, in the format of its file name extension; with --list, the folder "
                   "for all pictures")
      ->required();
  constexpr int least = 16;
  constexpr int most = 8192;
  command
      ->add_option("--size", arguments->size,
                   "Pixels on the longer side of each picture (default: 800; 400 with --day)")
      ->check(CLI::Range(least, most));
  command->callback([model, arguments] { run_view(model->run(), *arguments); });
}

void add_map(CLI::App& app, Choices const& choices) {
  auto* const command = app.add_subcommand(
      "map",
      "Map the sunlit hours and the beam solar energy over receivers, at the model's own timesteps "
      "and with its schedules: for each receiver a picture, a table and a NumPy array, and a list "
      "of all (maps.csv)");
  auto const model = std::make_shared<ModelArguments>(
      *command, choices, "Weather file: site, calendar and beam radiation (required)");
  auto const order = std::make_shared<MapOrder>();
  command->add_option("--from", order->from, "First day (default: 01-01)")->type_name("MM-DD");
  command->add_option("--to", order->to, "Last day (default: 12-31)")->type_name("MM-DD");
  command
      ->add_option("--receivers", order->receivers,
                   "Name of a surface, or a pattern in which * stands for any characters; also "
                   "of shading surfaces (default: all surfaces that EnergyPlus shades)")
      ->type_name("PATTERN");
  constexpr double least_spacing = 0.001;
  constexpr double most_spacing = 1000.0;
  command->add_option("--spacing", order->spacing, "Largest side of a cell, m")
      ->check(CLI::Range(least_spacing, most_spacing))
      ->capture_default_str()
      ->type_name("M");
  constexpr int most_rays = 100;
  command
      ->add_option("--rays", order->rays_per_cell,
                   "Rays from each cell to each position of the sun")
      ->check(CLI::Range(1, most_rays))
      ->capture_default_str()
      ->type_name("N");
  command->add_flag(
      "--common-scale", order->common_scale,
      "One colour scale for the pictures of all receivers; otherwise each has its own");
  command
      ->add_option("-o,--output", order->folder,
                   "Folder for the maps: new, empty, or with earlier maps, which are replaced")
      ->required();
  command->callback([model, order] { draw_maps(model->run(), *order); });
}

void add_export(CLI::App& app, Choices const& choices) {
  struct Arguments {
    EnergyPlusCall call;
    std::string folder;
    std::string imported;
  };
  auto* const command = app.add_subcommand(
      "export",
      "Render sunlit fractions of the run periods, for an EnergyPlus without this renderer");
  auto const model = std::make_shared<ModelArguments>(*command, choices);
  auto const arguments = std::make_shared<Arguments>();
  command->add_flag("-x,--expandobjects", arguments->call.expand, "Run ExpandObjects first");
  command->add_flag("-a,--annual", arguments->call.annual,
                    "Simulate a whole year, whatever the run periods");
  auto* const outputs = command->add_option_group("output");
  outputs->add_option("--scheduled", arguments->folder,
                      "Write the model, with its sunlit fractions as schedules, into this folder");
  outputs->add_option(
      "--imported", arguments->imported,
      "Write the file for Schedule:File:Shading (not for the tested EnergyPlus, whose "
      "method Imported does not find its surfaces)");
  outputs->require_option(1);
  command->callback([model, arguments] {
    auto const run = model->run();
    auto call = arguments->call;
    call.model = run.model;
    call.weather = run.weather;
    if (arguments->imported.empty()) {
      export_scheduled(std::move(call), run.choices, arguments->folder);
    } else {
      export_imported(std::move(call), run.choices, arguments->imported);
    }
  });
}

void add_screen(CLI::App& app, Choices const& choices) {
  auto* const command = app.add_subcommand(
      "screen",
      "Print the sheet and the transmittance by angle of incidence and azimuth of the perforated "
      "screens of a model, and write tables, polar plots and pictures of them. EnergyPlus is not "
      "run");
  auto const task = std::make_shared<ScreenTask>();
  auto const folder = std::make_shared<std::string>();
  command->add_option("model", task->model, "IDF or epJSON file")->required();
  command->add_option("name", task->name,
                      "Name of a GPUShading:PerforatedScreen, or a pattern in which * stands for "
                      "any characters (default: all)");
  command->add_option(
      "-o,--output", *folder,
      "Folder for NAME_tau.csv (transmittance by angles), NAME_tau.svg (polar plot) "
      "and NAME_tile.png (one tile of the sheet)");
  auto const bsdf = std::make_shared<std::string>();
  command
      ->add_option("--bsdf", *bsdf,
                   "File for one screen as a BSDF, in WINDOW's XML with Klems's 145 x 145 "
                   "directions: direct transmission, and diffuse reflection of the faces")
      ->type_name("FILE");
  command->footer(std::string(flags_help()));
  command->callback([task, folder, bsdf, choices] {
    if (!folder->empty()) task->folder = *folder;
    if (!bsdf->empty()) task->bsdf = *bsdf;
    describe_screens(*task, choices);
  });
}

// "3/8".
Shard parse_shard(std::string const& text) {
  auto const slash = text.find('/');
  auto const number = parse_number(text.substr(0, slash));
  auto const shards = parse_number(slash == std::string::npos ? "" : text.substr(slash + 1));
  constexpr double most = 10000.0;
  bool const whole =
      number && shards && std::floor(*number) == *number && std::floor(*shards) == *shards;
  if (!whole || *number < 1.0 || *number > *shards || *shards > most) {
    throw Error(fmt::format("--shard {}: expected I/N, the I-th of N shards, such as 3/8", text));
  }
  return {static_cast<int>(*number), static_cast<int>(*shards)};
}

void add_sample(CLI::App& app, Choices const& choices) {
  struct Arguments {
    std::string mode = "medium";
    std::string folder;
    std::string shard;
    int merge = 0;
    bool sky = false;
  };
  auto* const command = app.add_subcommand(
      "sample",
      "Sample sunlit fractions as --gpu-shading-update sampled:... does, without a run, and write "
      "tables of the samples and of every 15 minutes of the year; or sunlit fractions for patches "
      "of "
      "the sky");
  auto const model = std::make_shared<ModelArguments>(
      *command, choices, "Weather file: site and calendar (required, except with --sky)");
  auto const arguments = std::make_shared<Arguments>();
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder for samples.csv and year.csv, or for sky.csv and sky_view.csv")
      ->required();
  auto* const mode = command->add_option("--mode", arguments->mode, "Density of the samples");
  mode->check(
          CLI::IsMember({"fine", "medium", "coarse", "paper-fine", "paper-medium", "paper-coarse"}))
      ->capture_default_str();
  auto* const shard = command->add_option(
      "--shard", arguments->shard,
      "Render the I-th of N shares of one round and keep it in the folder; repeat for all shares, "
      "then for the next round, until all rounds are complete");
  constexpr int most_shards = 10000;
  command
      ->add_option("--merge", arguments->merge,
                   "Write the tables from the parts that N shards have rendered; render nothing")
      ->check(CLI::Range(1, most_shards))
      ->excludes(shard)
      ->type_name("N");
  shard->type_name("I/N");
  command
      ->add_flag("--sky", arguments->sky,
                 "Instead, for the patches of EnergyPlus's, Tregenza's and Reinhart's skies, with "
                 "view factors to the sky; transmittance schedules are at their lowest value and "
                 "screens fully deployed")
      ->excludes(mode, shard, command->get_option("--merge"));
  command->callback([model, arguments] {
    auto run = model->run();
    if (arguments->sky) {
      sample_sky(run, arguments->folder);
      return;
    }
    std::vector<std::string> flag{"--gpu-shading-update=sampled:" + arguments->mode};
    run.choices.update = take_flags(flag).update;
    SampleTask task{arguments->folder};
    if (!arguments->shard.empty()) task.shard = parse_shard(arguments->shard);
    if (arguments->merge > 0) task.merge = arguments->merge;
    sample(run, task);
  });
}

std::vector<std::string> names_of(std::vector<CLI::App const*> const& commands) {
  std::vector<std::string> names(commands.size());
  std::transform(commands.begin(), commands.end(), names.begin(),
                 [](CLI::App const* command) { return command->get_name(); });
  return names;
}

void refuse_mistyped_subcommand(CLI::App const& app, std::vector<std::string> const& arguments) {
  if (arguments.empty() || arguments.front().starts_with("-")) return;
  auto const& word = arguments.front();
  auto const names = names_of(app.get_subcommands({}));
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw Error(fmt::format("{}: no such subcommand{}", printable(word), did_you_mean(word, names)));
}

// Names the first argument that no subcommand takes.
[[noreturn]] void refuse_extras(CLI::App const& app) {
  std::vector<std::string> flags;
  for (auto const* const command : app.get_subcommands()) {
    for (auto const* const option : command->get_options()) {
      for (auto const& name : option->get_lnames()) flags.push_back("--" + name);
    }
  }
  auto const extras = app.remaining(true);
  auto const flag = extras.empty() ? "" : extras.front().substr(0, extras.front().find('='));
  auto const* const kind = flag.starts_with("-") ? "no such flag" : "not expected";
  throw Error(fmt::format("{}: {}{}", printable(flag), kind, did_you_mean(flag, flags)));
}

void add_version(CLI::App& app) {
  auto const text = "gpu_shading " GPU_SHADING_VERSION;
  app.set_version_flag("--version", text);
  for (auto* const command : app.get_subcommands({})) command->set_version_flag("--version", text);
}

int run(std::vector<std::string> arguments) {
  auto choices = take_flags(arguments);
  choices.fill_from(read_environment());
  apply_to_process(choices);
  CLI::App app{
      "List devices, check, draw and map models, describe screens, sample and export sunlit "
      "fractions "
      "for EnergyPlus with GPU shading",
      "gpu_shading"};
  app.require_subcommand(1);
  bool right = true;
  add_devices(app, right);
  add_check(app, choices);
  add_view(app, choices);
  add_map(app, choices);
  add_screen(app, choices);
  add_sample(app, choices);
  add_export(app, choices);
  add_version(app);
  refuse_mistyped_subcommand(app, arguments);
  // CLI11 expects them in reverse order.
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(std::move(arguments));
  } catch (CLI::ExtrasError const&) {
    refuse_extras(app);
  } catch (CLI::RequiredError const& error) {
    // What is missing may be there, but mistyped.
    if (!app.remaining(true).empty()) refuse_extras(app);
    throw Error(error.what());
  } catch (CLI::ParseError const& error) {
    // --help and --version are such errors too.
    if (error.get_exit_code() == EXIT_SUCCESS) return app.exit(error);
    throw Error(error.what());
  }
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace gpu_shading::energyplus

int main(int argc, char** argv) {
  gpu_shading::energyplus::catch_lack_of_memory();
  gpu_shading::energyplus::take_file_limit_as_error();
  gpu_shading::energyplus::clean_up_at_signals();
  gpu_shading::energyplus::occupy_standard_descriptors();
  try {
    int const status =
        gpu_shading::energyplus::run(gpu_shading::energyplus::arguments_of(argc, argv));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw gpu_shading::Error("standard output: cannot be written");
    }
    return status;
  } catch (gpu_shading::energyplus::Interrupted const& interrupted) {
    interrupted.raise();
    return EXIT_FAILURE;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n",
                 gpu_shading::energyplus::error_line(error).c_str());
    return EXIT_FAILURE;
  }
}
