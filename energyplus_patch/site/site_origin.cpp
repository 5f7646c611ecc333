#include "site/site_origin.h"

#include "gpu_shading/error.h"
#include "input/fields.h"
#include "input/naming.h"

namespace gpu_shading::energyplus {
namespace {

constexpr Field origin_latitude{"origin_latitude", "Origin Latitude"};
constexpr Field origin_longitude{"origin_longitude", "Origin Longitude"};
constexpr Field origin_elevation{"origin_elevation", "Origin Elevation"};

// What one object says of the origin.
struct Statement {
  std::optional<double> latitude;
  std::optional<double> longitude;
  std::optional<double> elevation;
  bool at_terrain = false;

  bool operator==(Statement const&) const = default;
  bool empty() const { return *this == Statement{}; }
};

Statement read_statement(InputObject const& object) {
  Statement statement;
  statement.latitude = number(object, origin_latitude);
  statement.longitude = number(object, origin_longitude);
  if (statement.latitude.has_value() != statement.longitude.has_value()) {
    throw Error(fmt::format("{} is blank, expected degrees as {} is given",
                            statement.latitude ? origin_longitude.title : origin_latitude.title,
                            statement.latitude ? origin_latitude.title : origin_longitude.title));
  }
  statement.at_terrain = same_name(object[origin_elevation.name], "Terrain");
  if (!statement.at_terrain) statement.elevation = number(object, origin_elevation);
  return statement;
}

Statement read_location(std::vector<InputObject> const& objects) {
  for (auto const& object : objects) {
    if (object.type != "Site:Location") continue;
    return naming(object.title(), [&] {
      return Statement{number(object, {"latitude", "Latitude"}).value_or(0.0),
                       number(object, {"longitude", "Longitude"}).value_or(0.0),
                       number(object, {"elevation", "Elevation"}).value_or(0.0)};
    });
  }
  return {};
}

}  // namespace

SiteOrigin find_site_origin(std::vector<InputObject> const& objects) {
  Statement stated;
  std::string first;  // which object said so
  for (auto const& object : objects) {
    if (object.type != "GPUShading:SiteContext") continue;
    naming(object.title(), [&] {
      auto const statement = read_statement(object);
      if (statement.empty()) return;
      if (!first.empty() && statement != stated) {
        throw Error(
            fmt::format("its origin is not that of {}: a model has one place on earth", first));
      }
      stated = statement;
      if (first.empty()) first = object.title();
    });
  }
  auto const location = read_location(objects);
  SiteOrigin origin;
  origin.source = stated.latitude ? first : "Site:Location";
  auto const latitude = stated.latitude ? stated.latitude : location.latitude;
  auto const longitude = stated.latitude ? stated.longitude : location.longitude;
  auto const elevation = stated.elevation ? stated.elevation : location.elevation;
  if (!latitude || (!elevation && !stated.at_terrain)) {
    throw Error(fmt::format(
        "Site:Location is missing, expected it or a GPUShading:SiteContext with {}, {} and {}",
        origin_latitude.title, origin_longitude.title, origin_elevation.title));
  }
  origin.place = {*latitude, *longitude, elevation.value_or(0.0)};
  origin.at_terrain = stated.at_terrain;
  naming(origin.source, [&] { LocalAxes const check(origin.place); });
  return origin;
}

}  // namespace gpu_shading::energyplus
