#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/model_reader.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/listed_folder.h"
#include "programs/gpu_shading/module_files.h"
#include "programs/gpu_shading/run_period.h"
#include "runs/installation.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

struct ModulesOrder {
  DayOptions days;
  Path folder;
};

PvModules const& spec_of(Model const& model, ModuleField const& field) {
  for (auto const& modules : model.pv_modules) {
    if (modules.name == field.object) return modules;
  }
  throw Error(fmt::format("{}: was changed meanwhile", model.file));
}

// The arrays are in `folder`, by the fields' numbers.
std::vector<FieldLight> shade(ModelRun const& run, RunTimes const& times, Path const& folder) {
  StandardError const progress;
  auto const file = folder / "fields";
  auto const reply = run_task(run, ModulesTask{times, folder, file, progress.descriptor()});
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  print_line(reply.text);
  auto const model = read_model(run.model, run.choices);
  FileNames names;
  std::vector<FieldLight> fields;
  for (auto& field : read_module_fields(file)) {
    auto const& spec = spec_of(model, field);
    auto const array = folder / std::to_string(fields.size());
    fields.push_back(read_light(std::move(field), spec, times, array));
    fields.back().stem = names.add(fields.back().field.surface, "");
  }
  return fields;
}

Json describe(FieldLight const& light) {
  auto const& spec = light.layout.spec();
  return {{"object", spec.name},
          {"surface", light.field.surface},
          {"files", light.stem},
          {"modules", light.layout.modules().size()},
          {"strings", light.layout.strings()},
          {"cell_columns", spec.cell_columns},
          {"cell_rows", spec.cell_rows},
          {"bypass_diodes", spec.diodes},
          {"half_cut", spec.half_cut},
          {"module_area", spec.width * spec.length},
          {"module_width", spec.width},
          {"landscape", spec.orientation == PvModules::Orientation::landscape}};
}

void write_picture(Figure const& figure, std::string const& stem, std::string const& title,
                   ListedFolder& folder) {
  folder.write(stem + ".svg", [&](std::ostream& out) {
    figure.write_svg(printable(title), "Photovoltaic modules and the beam that they get.", out);
  });
  try {
    folder.write(stem + ".png", figure.encode(stem + ".png"));
  } catch (Error const& error) {
    // Installations without the picture formats have the rest.
    print_line(fmt::format("warning: no .png pictures: {}", error.what()));
  }
}

void write_pictures(FieldLight const& light, RunTimes const& run, std::string const& period,
                    ListedFolder& folder) {
  write_picture(draw_field(light, period), light.stem, light.field.surface, folder);
  constexpr int most = 20;
  for (int s = 0; s < std::min(light.layout.strings(), most); ++s) {
    write_picture(draw_string(light, s, run), fmt::format("{}_string_{}", light.stem, s + 1),
                  light.field.surface, folder);
  }
}

void shade_modules(ModelRun const& run, ModulesOrder const& order) {
  require_model(run.model);
  auto const site = read_weather_site(weather_of(run));
  auto const period = period_of(order.days);
  ListedFolder folder(order.folder, "modules.json", "gpu_shading modules 1");
  auto const times = times_of(run, period);
  TemporaryFolder const temporary;
  auto const fields = shade(run, times, temporary.path());
  Json described = Json::array();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    auto const array = temporary.path() / std::to_string(i);
    folder.write(fields[i].stem + ".npy", [&](std::ostream& out) {
      write_cells(fields[i], times.times.size(), array, out);
    });
    write_pictures(fields[i], times, describe_days(period), folder);
    described.push_back(describe(fields[i]));
  }
  folder.write("modules.csv", [&](std::ostream& out) { write_modules(fields, out); });
  folder.write("strings.csv", [&](std::ostream& out) { write_strings(fields, times, out); });
  folder.write("times.csv", [&](std::ostream& out) { write_times(times, out); });
  folder.commit(Json{
      {"versions",
       {{"gpu_shading", GPU_SHADING_VERSION}, {"energyplus", read_version(own_folder())}}},
      {"model", run.model.filename().string()},
      {"weather", run.weather->filename().string()},
      {"site", {{"name", site.name}, {"latitude", site.latitude}, {"longitude", site.longitude}}},
      {"year", times.year},
      {"steps_per_hour", times.steps_per_hour},
      {"fields", std::move(described)}});
  print("{}\n", (order.folder / "modules.csv").string());
}

}  // namespace

void add_modules(Program const& program) {
  Command const command(
      program, "modules",
      "Beam sunlit fraction of every cell of photovoltaic modules (GPUShading:PVModules) at the "
      "model's own timesteps, and the view factor of every module to the sky: arrays for NumPy, "
      "tables by module and by string, and pictures",
      model_options());
  auto const model =
      command.add_model("Weather file: site, calendar and beam radiation (required)");
  auto const order = std::make_shared<ModulesOrder>();
  add_days(*command.operator->(), order->days);
  command.add_folder(order->folder, "results");
  command.run([model, order] { shade_modules(*model, *order); });
}

}  // namespace gpu_shading::energyplus
