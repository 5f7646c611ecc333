
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gpu_shading/error.h"
#include "gpu_shading/footprint.h"
#include "gpu_shading/terrain.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "model/site/building_file.h"
#include "model/site/horizon.h"
#include "model/site/surroundings.h"
#include "model/site/terrain_file.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::site_context;

HeightRule read_heights(InputObject const& object) {
  HeightRule rule;
  rule.height = read(object, field::height_property);
  rule.levels = read(object, field::levels_property);
  rule.storey = read(object, field::storey_height);
  rule.otherwise = read(object, field::default_height);
  return rule;
}

// One object with the contents of its files.
struct Context {
  std::string name;
  std::string file;                       // file of buildings, as the user wrote it
  std::optional<geojson::Nearby> nearby;  // of what is drawn
  std::optional<double> horizon;          // m, the radius of what is read
  std::optional<BuildingFile> buildings;
  std::optional<TerrainGrid> terrain;
  double clear_distance = 0.0;
  std::vector<std::string> left_out;
};

Context read_context(InputObject const& object, std::filesystem::path const& folder, bool horizons,
                     GeographicPoint const& origin) {
  Context context;
  context.name = object.name;
  context.left_out = read(object, field::left_out_name);
  context.horizon = read(object, field::horizon_radius);
  if (auto const radius = read(object, field::radius)) {
    context.nearby = geojson::Nearby{origin, *radius};
  }
  if (context.horizon && !(context.nearby && context.nearby->radius() < *context.horizon)) {
    throw Error(fmt::format("{} is {:g} m, expected more than {}", field::horizon_radius.title,
                            *context.horizon, field::radius.title));
  }
  auto const buildings = read(object, field::buildings_file_name);
  auto const terrain = read(object, field::terrain_file_name);
  if (buildings.empty() && terrain.empty()) {
    throw Error(fmt::format("{} and {} are blank, expected one of them or both",
                            field::buildings_file_name.title, field::terrain_file_name.title));
  }
  if (buildings.empty()) {
    expect_blank(object,
                 {field::buildings_coordinates, field::height_property, field::levels_property,
                  field::storey_height, field::default_height},
                 "without Buildings File Name");
    if (!context.horizon) expect_blank(object, {field::radius}, "without Buildings File Name");
  } else {
    auto const coordinates = read_map_coordinates(object, field::buildings_coordinates);
    auto const heights = read_heights(object);
    context.file = buildings;
    auto nearby = context.nearby;
    if (context.horizon && horizons) nearby = geojson::Nearby(origin, *context.horizon);
    context.buildings = naming(field::buildings_file_name.title, [&] {
      return read_buildings(folder / buildings, heights, coordinates, nearby);
    });
  }
  if (terrain.empty()) {
    expect_blank(object, {field::terrain_coordinates, field::terrain_clear_distance},
                 "without Terrain File Name");
  } else {
    auto const coordinates = read_map_coordinates(object, field::terrain_coordinates);
    context.clear_distance = read(object, field::terrain_clear_distance).value_or(0.0);
    context.terrain = naming(field::terrain_file_name.title,
                             [&] { return read_terrain(folder / terrain, coordinates); });
  }
  return context;
}

// Elevation of the ground below a building: the lowest of its corners, so that no side is in the
// air. Corners where the terrain has no data are ignored.
double ground_below(Footprint const& part, TerrainGrid const& terrain) {
  double lowest = std::numeric_limits<double>::infinity();
  for (auto const& corner : part.outline) {
    if (auto const elevation = elevation_at(terrain, corner)) {
      lowest = std::min(lowest, *elevation);
    }
  }
  if (std::isinf(lowest)) {
    throw Error("none of its corners is on the terrain, expected ground below every building");
  }
  return lowest;
}

// Creates the casters of one context.
class Builder {
 public:
  Builder(Context const& context, SiteOrigin const& origin, Surroundings& surroundings)
      : context_(context), origin_(origin), axes_(origin.place), surroundings_(surroundings) {}

  void build() {
    if (context_.terrain) {
      naming(field::terrain_file_name.title, [&] { add_terrain(*context_.terrain); });
    }
    if (context_.buildings) {
      naming(field::buildings_file_name.title, [&] { add_buildings(*context_.buildings); });
    }
    if (context_.horizon) add_horizon();
    constexpr double near = 5e4;  // m
    if (extent_.distance() > near) {
      surroundings_.warnings.push_back(
          fmt::format("{} {}: all of it is farther than {:.0f} km from the model: check the "
                      "origin, and that each position gives the longitude first",
                      field::type, context_.name, near / 1000.0));
    }
    surroundings_.remarks.push_back(fmt::format("{} {}: {}; {}; origin {}", field::type,
                                                context_.name, described_, extent_.describe(),
                                                describe_origin()));
  }

 private:
  void add(std::string const& name, Polygon polygon) {
    extent_.include(polygon.outline);
    OutsideCaster caster;
    caster.surface.name = name;
    caster.surface.polygon = std::move(polygon);
    surroundings_.casters.push_back(std::move(caster));
  }

  void add_name(std::string const& name) {
    surroundings_.types.try_emplace(name, std::string(field::type));
  }

  void describe(std::string const& part) { described_ += (described_.empty() ? "" : ", ") + part; }

  void add_terrain(TerrainGrid const& terrain) {
    auto const name = upper(context_.name) + ":TERRAIN";
    add_name(name);
    auto polygons = ground(terrain, axes_, context_.clear_distance);
    if (context_.horizon) take_into_horizon(polygons);
    describe(fmt::format("terrain of {} x {} nodes ({} cells drawn{})", terrain.columns,
                         terrain.rows, polygons.size(), describe_north(terrain.coordinates)));
    surroundings_.casters.reserve(surroundings_.casters.size() + polygons.size());
    for (auto& polygon : polygons) add(name, std::move(polygon));
    warn_of_elevation(terrain);
  }

  // Leaves what is within the radius.
  void take_into_horizon(std::vector<Polygon>& polygons) {
    std::erase_if(polygons, [&](Polygon const& polygon) {
      double distance = std::numeric_limits<double>::infinity();
      for (auto const& corner : polygon.outline) {
        distance = std::min(distance, std::hypot(corner.x, corner.y));
      }
      if (distance <= context_.nearby->radius()) return false;
      if (distance <= *context_.horizon) horizon_.include(polygon.outline);
      return true;
    });
  }

  bool is_in_horizon(Building const& building) const {
    if (!context_.horizon) return false;
    geojson::GeographicExtent extent;
    for (auto const& part : building.parts) {
      for (auto const& corner : part.outline) extent.include(corner);
    }
    return !context_.nearby->reaches(extent);
  }

  void add_horizon() {
    auto const name = upper(context_.name) + ":HORIZON";
    add_name(name);
    auto faces = horizon_.faces();
    describe(fmt::format("horizon of what is within {:g} m ({} degrees)", *context_.horizon,
                         faces.size()));
    for (auto& face : faces) add(name, std::move(face));
  }

  std::string describe_north(MapCoordinates const& coordinates) const {
    if (coordinates.geographic()) return {};
    double const turned = coordinates.convergence(coordinates.from_geographic(origin_.place));
    return fmt::format(", {}: grid north {:.3f} degrees {} of true north", coordinates.name(),
                       std::abs(turned), turned < 0.0 ? "west" : "east");
  }

  void warn_of_elevation(TerrainGrid const& terrain) {
    auto const there = elevation_at(terrain, origin_.place);
    constexpr double alike = 5.0;  // m
    if (!there || std::abs(*there - origin_.place.elevation) <= alike) return;
    surroundings_.warnings.push_back(
        fmt::format("{} {}: at the origin the terrain is at {:.1f} m, the model's ground at {:.1f} "
                    "m: give Origin Elevation, or Terrain for it",
                    field::type, context_.name, *there, origin_.place.elevation));
  }

  void add_buildings(BuildingFile const& file) {
    std::size_t drawn = 0;
    std::size_t faces = 0;
    std::size_t left_out = 0;
    for (auto const& building : file.buildings) {
      if (matches_any(context_.left_out, building.name)) {
        ++left_out;
        continue;
      }
      auto const name = upper(context_.name + ":" + building.name);
      bool const in_horizon = is_in_horizon(building);
      if (!in_horizon) {
        add_name(name);
        ++drawn;
      }
      for (auto part : building.parts) {
        if (in_horizon) {
          include_in_horizon(part);
          continue;
        }
        faces += naming(fmt::format("{}: {}", context_.file, building.label),
                        [&] { return add_part(name, std::move(part)); });
      }
    }
    describe(
        fmt::format("{} building{}{} ({} walls and roofs{}{}{})", drawn, drawn == 1 ? "" : "s",
                    context_.nearby ? fmt::format(" within {:g} m", context_.nearby->radius()) : "",
                    faces, left_out == 0 ? "" : fmt::format(", {} left out", left_out),
                    file.others == 0 ? "" : fmt::format(", {} features without area", file.others),
                    describe_north(file.coordinates)));
  }

  double ground_of(Footprint const& part) const {
    return context_.terrain ? ground_below(part, *context_.terrain) : origin_.place.elevation;
  }

  std::size_t add_part(std::string const& name, Footprint part) {
    double const below = ground_of(part);
    part.base += below;
    part.top += below;
    auto faces = upright_prism(part, axes_);
    double base = std::numeric_limits<double>::infinity();
    for (auto const& corner : faces[1].outline) base = std::min(base, corner.z);
    surroundings_.buildings.push_back({name, faces[0], base});
    for (auto& face : faces) add(name, std::move(face));
    return faces.size();
  }

  void include_in_horizon(Footprint const& part) {
    double const top = part.top + ground_of(part);
    Ring roof;
    for (auto const& corner : part.outline) {
      roof.push_back(axes_.to_local({corner.latitude, corner.longitude, top}));
    }
    horizon_.include(roof);
  }

  std::string describe_origin() const {
    return fmt::format("{:.6f} {} {:.6f} {} {:.1f} m ({})", std::abs(origin_.place.latitude),
                       origin_.place.latitude < 0.0 ? "S" : "N", std::abs(origin_.place.longitude),
                       origin_.place.longitude < 0.0 ? "W" : "E", origin_.place.elevation,
                       origin_.source);
  }

  Context const& context_;
  SiteOrigin const& origin_;
  LocalAxes axes_;
  Surroundings& surroundings_;
  Extent extent_;
  Horizon horizon_;
  std::string described_;
};

void stand_on_terrain(std::vector<Context> const& contexts, SiteOrigin& origin) {
  for (auto const& context : contexts) {
    if (!context.terrain) continue;
    if (auto const elevation = elevation_at(*context.terrain, origin.place)) {
      origin.place.elevation = *elevation;
      origin.source += ", at the terrain's elevation";
      return;
    }
  }
  throw Error(
      fmt::format("{}: Origin Elevation is Terrain, but no terrain has data at latitude {}, "
                  "longitude {}",
                  field::type, origin.place.latitude, origin.place.longitude));
}

}  // namespace

std::optional<MapCoordinates> read_map_coordinates(InputObject const& object,
                                                   Field<std::string> const& coordinates) {
  auto const text = read(object, coordinates);
  if (text.empty()) return std::nullopt;
  try {
    return MapCoordinates::parse(text);
  } catch (Error const& error) {
    throw Error(fmt::format("{} is {}", coordinates.title, error.what()));
  }
}

std::vector<TerrainGrid> read_site_contexts(std::vector<InputObject> const& objects,
                                            std::filesystem::path const& folder, bool horizons,
                                            SiteOrigin& origin, Surroundings& surroundings) {
  std::vector<Context> contexts;
  for_each_of(objects, field::type, [&](InputObject const& object) {
    contexts.push_back(read_context(object, folder, horizons, origin.place));
  });
  if (origin.at_terrain) stand_on_terrain(contexts, origin);
  for (auto const& context : contexts) {
    naming(fmt::format("{} {}", field::type, context.name),
           [&] { Builder(context, origin, surroundings).build(); });
  }
  std::vector<TerrainGrid> terrains;
  for (auto& context : contexts) {
    if (context.terrain) terrains.push_back(std::move(*context.terrain));
  }
  return terrains;
}

}  // namespace gpu_shading::energyplus
