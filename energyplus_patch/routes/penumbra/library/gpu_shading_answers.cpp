#include "gpu_shading_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "calculation/plain_scene.h"
#include "calculation/session.h"
#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "routes/run_setup.h"
#include "runs/schedule_value.h"

namespace gpu_shading::answers {
namespace {

using namespace energyplus;

// One run of EnergyPlus, from its command line on. EnergyPlus passes no run to its functions, but
// keeps to one thread from beginning to end, hence thread-local.
struct SourceRun {
  bool wanted = false;
  Choices choices;
  std::string wrong;           // why the options cannot be used, "" if they can
  std::optional<Model> model;  // once it is read
};

SourceRun& source_run() {
  thread_local SourceRun run;
  return run;
}

std::unique_ptr<ShadingCalculation> make_calculation(unsigned size, Log const& log) {
  if (auto const& model = source_run().model) return std::make_unique<Session>(*model);
  RendererOptions options;
  options.resolution = static_cast<int>(size);
  options.warn = log.warning;
  return std::make_unique<PlainScene>(std::move(options));
}

Messages messages_of(Log const& log, Simulation const& simulation) {
  auto const eio = simulation.initialization;
  return {[warn = log.warning](std::string const& line) {
            print_line("warning: " + line);
            warn(line);
          },
          [tell = log.info](std::string const& line) {
            print_line(line);
            tell(line);
          },
          [eio](std::string const& text) {
            if (eio) eio(text);
          }};
}

// The simulation's schedules by name, whose numbers are asked for once.
Schedules schedules_of(Simulation const& simulation) {
  auto const numbers = std::make_shared<std::map<std::string, int>>();
  auto const number = [find = simulation.schedule, numbers](std::string const& name) {
    auto const [place, added] = numbers->try_emplace(name, 0);
    if (added && find) place->second = find(name);
    if (place->second == 0) throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", name));
    return place->second;
  };
  auto const range = [number, range_of = simulation.schedule_range](std::string const& name) {
    auto const [low, high] = range_of(number(name));
    return std::pair(checked_share(name, low), checked_share(name, high));
  };
  return {range, [number, range, value_of = simulation.schedule_value](std::string const& name,
                                                                       Moment moment) {
            if (moment.timestep <= 0) return range(name).first;
            return checked_share(name, value_of(number(name), moment.hour, moment.timestep));
          }};
}

// What EnergyPlus is to read instead of the model.
Rewrite take_model(std::vector<InputObject> objects, std::filesystem::path const& path,
                   std::string const& version, MentionFinder const& find_mentions) {
  auto& run = source_run();
  constexpr bool daylight_rays = true;
  Reader reader{find_mentions, daylight_rays};
  reader.release = Release{version, "IDFVersionUpdater"};
  auto model = understand(std::move(objects), path, run.choices, reader);
  auto rewrite = rewrite_for(model);
  if (model.options.mode != Mode::off) {
    for (auto const& warning : model.early_warnings) {
      print_line("warning: " + warning);
    }
    run.model = std::move(model);
  }
  return rewrite;
}

// EnergyPlus itself asks this library, which is no choice.
void warn_of_method(Choices const& choices) {
  auto const method = choices.method.value_or(Method::automatic);
  if (method == Method::automatic) return;
  print_line(
      fmt::format("warning: --gpu-shading-method {}: ignored, because this EnergyPlus was compiled "
                  "with gpu_shading",
                  name_of(method)));
}

}  // namespace

class Calculation::Implementation {
 public:
  Implementation(unsigned size, Log given)
      : log(std::move(given)), shading(make_calculation(size, log)) {
    auto const& model = source_run().model;
    rays_answered = model && model->daylighting_answered;
  }

  // Calls use(calculation), which fails where that throws.
  template <typename Use>
  auto with(Use const& use) {
    try {
      return use(*shading);
    } catch (...) {
      shading->fail();
      throw;
    }
  }

  Log log;
  std::unique_ptr<ShadingCalculation> shading;
  bool rays_answered = false;
};

Calculation::Calculation(unsigned size, Log log)
    : implementation_(std::make_unique<Implementation>(size, std::move(log))) {}

Calculation::~Calculation() = default;

unsigned Calculation::add(PlainSurface surface) {
  Surface added{.name = std::move(surface.name), .polygon = {to_ring(surface.outline), {}}};
  for (auto const& hole : surface.holes) added.polygon.holes.push_back(to_ring(hole));
  return implementation_->shading->add(std::move(added));
}

int Calculation::add_mirrored(unsigned original) {
  auto& shading = *implementation_->shading;
  if (!shading.wants_mirrored()) return -1;
  if (original >= shading.size()) throw Error("a mirrored surface comes before its original");
  return static_cast<int>(shading.add_mirrored(original));
}

void Calculation::start(Simulation const& simulation) {
  implementation_->shading->start({messages_of(implementation_->log, simulation),
                                   schedules_of(simulation), simulation.latitude});
}

void Calculation::set_time(int hour, int timestep) {
  implementation_->with([&](auto& shading) {
    shading.set_time(timestep > 0 ? Moment{hour, timestep} : Moment{});
  });
}

void Calculation::set_sun(double azimuth, double altitude) {
  implementation_->with([&](auto& shading) { shading.set_sun({azimuth, altitude}); });
}

float Calculation::sunlit_area(unsigned surface) {
  return implementation_->with(
      [&](auto& shading) { return static_cast<float>(shading.projected_sunlit_area(surface)); });
}

std::vector<float> Calculation::sunlit_areas(std::vector<unsigned> const& surfaces) {
  auto const areas = implementation_->with(
      [&](auto& shading) { return shading.projected_sunlit_areas(surfaces); });
  return {areas.begin(), areas.end()};
}

std::vector<float> Calculation::interior_areas(unsigned window,
                                               std::vector<unsigned> const& interiors) {
  auto const areas = implementation_->with(
      [&](auto& shading) { return shading.interior_areas(window, interiors); });
  return {areas.begin(), areas.end()};
}

double Calculation::ray_transmittance(DaylightRay const& ray) {
  constexpr double opaque_below = 1e-6;  // as EnergyPlus's shading surfaces are
  if (!implementation_->rays_answered) return 1.0;
  auto const& [origin, direction, hour] = ray;
  Ray const line{{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}};
  double const share = implementation_->with(
      [&line, hour = hour](auto& shading) { return shading.daylight_transmittance(line, hour); });
  return share < opaque_below ? 0.0 : share;
}

void Calculation::begin_daylighting() { implementation_->shading->begin_daylighting(); }

std::string Calculation::vendor() { return implementation_->shading->vendor(); }

void Calculation::finish() { implementation_->shading->finish(); }

std::vector<std::string> take_options(std::vector<std::string> arguments) {
  auto& run = source_run();
  run = {};
  try {
    RunSetup setup(arguments);
    refuse_surroundings(setup.choices);
    if (setup.wanted) warn_of_method(setup.choices);
    run.wanted = setup.wanted;
    run.choices = std::move(setup.choices);
    return std::move(setup.arguments);
  } catch (std::exception const& error) {
    run.wanted = true;
    run.wrong = error_line(error);
    // EnergyPlus would not know them, and say so instead.
    std::erase_if(arguments, [](auto const& each) { return each.starts_with("--gpu-shading"); });
    return arguments;
  }
}

std::string options_help() { return energyplus::options_help(); }

bool is_wanted() { return source_run().wanted; }

std::string read_model(std::string text, Format format, std::string const& path,
                       std::string const& version) {
  auto& run = source_run();
  if (!run.wrong.empty()) throw Error(run.wrong);
  if (!run.wanted) return text;
  auto const take = [&](std::vector<InputObject> objects, MentionFinder const& find) {
    return take_model(std::move(objects), path, version, find);
  };
  if (format == Format::idf) return rewrite_idf_model(text, path, take);
  auto json = parse_epjson(text);
  rewrite_epjson_model(json, path, take);
  return json.dump();
}

}  // namespace gpu_shading::answers
