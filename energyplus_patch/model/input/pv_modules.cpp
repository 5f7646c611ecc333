#include "model/input/pv_modules.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/fields.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::pvmodules;

// Walls and roofs that are exposed to the outdoors, windows and doors in them, shading surfaces.
std::vector<std::string> outdoor_surfaces(ShadingInput const& input) {
  std::vector<std::string> names;
  for (auto const& [name, zone] : input.zone_of) names.push_back(name);
  for (auto const& [name, base] : input.base_of) names.push_back(name);
  std::erase_if(names, [&](std::string const& name) {
    return input.not_exterior.contains(input.base_surface(name));
  });
  for (auto const& [name, surface] : input.shading_surfaces) names.push_back(name);
  return names;
}

void find_surfaces(InputObject const& object, std::vector<std::string> const& outdoors,
                   std::map<std::string, std::string>& taken, PvModules& modules) {
  auto const pattern = read(object, field::surface_name);
  auto const refuse = [&](std::string const& why) {
    throw Error(fmt::format("{} is {}: {}", field::surface_name.title, in_quotes(pattern), why));
  };
  for (auto const& name : outdoors) {
    if (!matches(pattern, name)) continue;
    auto const [place, added] = taken.try_emplace(name, object.name);
    if (!added) refuse(fmt::format("{} is named by {} already", name, place->second));
    modules.surfaces.push_back(name);
  }
  if (modules.surfaces.empty()) {
    refuse("no exterior or shading surface matches" + did_you_mean(pattern, outdoors));
  }
}

void read_cells(InputObject const& object, PvModules& modules) {
  modules.width = read(object, field::module_width);
  modules.length = read(object, field::module_length);
  modules.orientation = read(object, field::orientation);
  modules.cell_columns = read(object, field::cell_columns);
  modules.cell_rows = read(object, field::cell_rows);
  modules.diodes = read(object, field::bypass_diodes);
  modules.frame = read(object, field::frame_width);
  if (modules.cell_columns % modules.diodes != 0) {
    throw Error(fmt::format("{} is {}, expected a divisor of {} {}", field::bypass_diodes.title,
                            modules.diodes, field::cell_columns.title, modules.cell_columns));
  }
  modules.half_cut = read(object, field::half_cut) == field::HalfCut::yes;
  if (modules.half_cut && modules.cell_rows % 2 != 0) {
    throw Error(fmt::format("{} is {}, expected an even number for {}", field::cell_rows.title,
                            modules.cell_rows, field::half_cut.title));
  }
  double const shorter = std::min(modules.width, modules.length);
  if (2.0 * modules.frame >= shorter) {
    throw Error(fmt::format("{} is {}, expected less than half of the module's shorter side, {} m",
                            field::frame_width.title, modules.frame, shorter));
  }
}

}  // namespace

std::string PvModules::describe() const {
  return fmt::format("{}: {} surface{}, modules of {} m x {} m with {} x {} cells", where,
                     surfaces.size(), surfaces.size() == 1 ? "" : "s", width, length, cell_columns,
                     cell_rows);
}

std::vector<PvModules> read_pv_modules(std::vector<InputObject> const& objects,
                                       ShadingInput const& input) {
  std::vector<PvModules> all;
  std::map<std::string, std::string> taken;
  std::vector<std::string> outdoors;
  for_each_of(objects, field::type, [&](InputObject const& object) {
    if (outdoors.empty()) outdoors = outdoor_surfaces(input);
    PvModules modules;
    modules.name = object.name;
    modules.where = object.where();
    find_surfaces(object, outdoors, taken, modules);
    read_cells(object, modules);
    modules.gap = read(object, field::gap);
    modules.columns = read(object, field::module_columns);
    modules.rows = read(object, field::module_rows);
    modules.string_length = read(object, field::modules_per_string);
    modules.direction = read(object, field::string_direction);
    all.push_back(std::move(modules));
  });
  return all;
}

}  // namespace gpu_shading::energyplus
