#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/model_file.h"
#include "model/site/building_file.h"
#include "model/site/site_origin.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/staged_files.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

struct CityOrder {
  std::string footprints;
  std::string template_model;
  std::string models;  // a folder
  std::string places;  // a table
  std::string weather;
  std::string folder;
  double radius = 200.0;  // m
  std::optional<double> horizon;
  std::optional<double> default_height;
};

// A run of the plan.
struct Placed {
  Path model;
  std::string variant;
  GeographicPoint place;
  std::string own;  // the name of its building on the map; empty if it is not there
};

std::vector<Building> read_map(CityOrder const& order) {
  HeightRule const rule{"height", "building:levels", 3.0, order.default_height};
  return read_buildings(order.footprints, rule, std::nullopt).buildings;
}

// The centre of an area, in degrees as on a plane.
GeographicPoint centre_of(GeographicRing const& ring) {
  auto const& start = ring.front();
  double twice = 0.0;
  GeographicPoint sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& from = ring[i];
    auto const& to = ring[(i + 1) % ring.size()];
    double const cross = (from.longitude - start.longitude) * (to.latitude - start.latitude) -
                         (to.longitude - start.longitude) * (from.latitude - start.latitude);
    twice += cross;
    sum.longitude += cross * (from.longitude + to.longitude - 2.0 * start.longitude);
    sum.latitude += cross * (from.latitude + to.latitude - 2.0 * start.latitude);
  }
  if (twice == 0.0) return start;
  constexpr double thirds = 3.0;
  return {start.latitude + sum.latitude / (thirds * twice),
          start.longitude + sum.longitude / (thirds * twice), 0.0};
}

bool is_inside(GeographicRing const& ring, GeographicPoint const& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& from = ring[i];
    auto const& to = ring[(i + 1) % ring.size()];
    if ((from.latitude > point.latitude) == (to.latitude > point.latitude)) continue;
    double const share = (point.latitude - from.latitude) / (to.latitude - from.latitude);
    double const longitude = from.longitude + share * (to.longitude - from.longitude);
    if (point.longitude < longitude) inside = !inside;
  }
  return inside;
}

std::vector<Placed> place_template(CityOrder const& order, std::vector<Building> const& map) {
  require_model(order.template_model);
  read_objects(order.template_model);  // or each run of the plan would refuse it
  std::vector<Placed> runs;
  std::set<std::string> names;
  for (auto const& building : map) {
    auto name = building.name;
    for (int i = 2; !names.insert(name).second; ++i) name = fmt::format("{} {}", building.name, i);
    auto const& outline = building.parts.front().outline;
    if (outline.empty()) continue;
    runs.push_back({order.template_model, name, centre_of(outline), building.name});
  }
  return runs;
}

double read_degrees(std::string const& text, char const* name, double limit) {
  auto const value = parse_number(text);
  if (!value || !(std::abs(*value) <= limit)) {
    throw Error(
        fmt::format("{} is {}, expected -{:g} to {:g}", name, in_quotes(text), limit, limit));
  }
  return *value;
}

// A row for each model: its name in the folder, latitude and longitude.
std::map<std::string, GeographicPoint> read_places(Path const& path) {
  std::map<std::string, GeographicPoint> places;
  std::istringstream lines(read_text_file(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    naming(fmt::format("{}: line {}", path.string(), number), [&] {
      std::vector<std::string> fields;
      std::istringstream values(line);
      for (std::string value; std::getline(values, value, ',');) fields.push_back(value);
      if (number == 1) {
        if (fields == std::vector<std::string>{"model", "latitude", "longitude"}) return;
        throw Error("expected the columns model,latitude,longitude");
      }
      if (fields.size() != 3) throw Error("expected a model, its latitude and its longitude");
      GeographicPoint const place{read_degrees(fields[1], "latitude", 90.0),
                                  read_degrees(fields[2], "longitude", 180.0), 0.0};
      if (!places.emplace(fields[0], place).second) {
        throw Error(fmt::format("{} has a second place", in_quotes(fields[0])));
      }
    });
  }
  return places;
}

std::vector<Path> find_models(Path const& folder) {
  std::vector<Path> models;
  naming(folder.string(), [&] {
    for (auto const& entry : std::filesystem::recursive_directory_iterator(folder)) {
      auto const name = upper(entry.path().filename().string());
      if (name.ends_with(".GPU-SHADING.IDF")) continue;
      if (name.ends_with(".IDF") || name.ends_with(".EPJSON")) models.push_back(entry.path());
    }
    if (models.empty()) throw Error("has no models (IDF or epJSON)");
  });
  std::ranges::sort(models);
  return models;
}

std::vector<Placed> place_models(CityOrder const& order, std::vector<Building> const& map) {
  auto const places =
      order.places.empty() ? std::map<std::string, GeographicPoint>{} : read_places(order.places);
  std::vector<Placed> runs;
  for (auto const& model : find_models(order.models)) {
    Placed run{model, "", {}, ""};
    if (order.places.empty()) {
      run.place =
          naming(model.string(), [&] { return find_site_origin(read_objects(model)).place; });
    } else {
      auto const name = model.lexically_relative(order.models).generic_string();
      auto const found = places.find(name);
      if (found == places.end()) {
        throw Error(fmt::format("{}: has no row for the model {}", order.places, in_quotes(name)));
      }
      run.place = found->second;
    }
    for (auto const& building : map) {
      if (std::ranges::any_of(building.parts, [&](Footprint const& part) {
            return is_inside(part.outline, run.place);
          })) {
        run.own = building.name;
        break;
      }
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

// A pattern that matches the name, as an IDF can have it.
std::string as_pattern(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::string_view(",;!\r\n").find(c) != std::string_view::npos; }, '*');
  return name;
}

// The model's own extension objects, and the city around it.
std::string side_file_of(Placed const& run, CityOrder const& order) {
  auto side_file = run.model;
  side_file.replace_extension(".gpu-shading.idf");
  auto text = std::filesystem::exists(side_file) ? read_text_file(side_file) + "\n" : "";
  auto const map = std::filesystem::absolute(order.footprints).lexically_normal().string();
  if (map.find_first_of(",;!") != std::string::npos) {
    throw Error(fmt::format("{}: an IDF cannot name a file with , ; or ! in its path", map));
  }
  text +=
      fmt::format("{},City,{},,,,,{},,,,{:.9f},{:.9f},,{},{},{};\n", extension::site_context::type,
                  map, order.default_height ? fmt::format("{}", *order.default_height) : "",
                  run.place.latitude, run.place.longitude, order.radius,
                  order.horizon ? fmt::format("{}", *order.horizon) : "", as_pattern(run.own));
  return text;
}

std::string in_csv(std::string const& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (char const c : value) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

void plan_city(CityOrder const& order) {
  if (order.template_model.empty() == order.models.empty()) {
    throw Error("city: expected either --template or --models");
  }
  require_file(order.weather);
  auto const map = read_map(order);
  auto const runs = order.models.empty() ? place_template(order, map) : place_models(order, map);
  Path const folder = order.folder;
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder)) {
    throw Error(fmt::format("{}: exists and is not empty: choose another folder", folder.string()));
  }
  auto const target = std::filesystem::absolute(folder / "").parent_path();
  StagedFiles files(target.parent_path());
  auto const staged = files.add(target.filename().string());
  std::filesystem::create_directories(staged / "context");
  std::ofstream plan(staged / "plan.csv", std::ios::binary);
  plan << "model,weather,variant,extensions\n";
  auto const weather = in_csv(std::filesystem::absolute(order.weather).string());
  std::size_t alone = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto const& run = runs[i];
    auto const side_file = fmt::format("context/{:07}.idf", i + 1);
    std::ofstream(staged / side_file, std::ios::binary) << side_file_of(run, order);
    plan << in_csv(std::filesystem::absolute(run.model).lexically_normal().string()) << ','
         << weather << ',' << in_csv(run.variant) << ',' << side_file << '\n';
    if (run.own.empty()) ++alone;
  }
  plan.close();
  if (!plan) throw Error(fmt::format("{}: cannot be written", (folder / "plan.csv").string()));
  files.commit();
  if (alone > 0) {
    print_line(fmt::format("warning: {} models are on no building of {}: they shade no other",
                           alone, order.footprints));
  }
  print("{}\n", (folder / "plan.csv").string());
}

}  // namespace

void add_city(Program const& program) {
  Command const command(program, "city",
                        "Plan a study with a run for each building of a map, shaded by its "
                        "neighbours (then: gpu_shading study DIR/plan.csv)",
                        {});
  auto const order = std::make_shared<CityOrder>();
  command
      ->add_option("footprints", order->footprints,
                   "Buildings as GeoJSON, FlatGeobuf or GeoPackage")
      ->required()
      ->type_name("FILE");
  command->add_option("--template", order->template_model, "A model to run at each building")
      ->type_name("MODEL");
  command
      ->add_option("--models", order->models,
                   "A folder of models, each placed by its Site:Location or by --places")
      ->type_name("DIR");
  command
      ->add_option("--places", order->places,
                   "Table with the columns model,latitude,longitude, in place of Site:Location")
      ->type_name("CSV");
  command->add_option("-w,--weather", order->weather, "Weather file")
      ->required()
      ->type_name("FILE");
  command->add_option("--radius", order->radius, "Distance of neighbours that shade, in m")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--horizon", order->horizon,
                   "Distance of buildings that shade as a horizon, in m (default: none)")
      ->check(CLI::Range(1.0, 1e6));
  command
      ->add_option("--default-height", order->default_height,
                   "Height of buildings for which the map has none, in m")
      ->check(CLI::Range(0.1, 1e4));
  command->add_option("-o,--output", order->folder, "New folder for the plan")
      ->required()
      ->check(folder_name())
      ->type_name("DIR");
  command.run([order] { plan_city(*order); });
}

}  // namespace gpu_shading::energyplus
