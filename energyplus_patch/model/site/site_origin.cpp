#include "model/site/site_origin.h"

#include <fmt/format.h>

#include <variant>

#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "model/site/location_fields.h"
#include "platform/naming.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::site_context;

// The origin that one object gives.
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
  if (auto const place =
          read_coordinates(object, field::origin_latitude, field::origin_longitude)) {
    statement.latitude = place->latitude;
    statement.longitude = place->longitude;
  }
  if (auto const elevation = read(object, field::origin_elevation)) {
    statement.at_terrain = std::holds_alternative<field::OriginElevation>(*elevation);
    if (!statement.at_terrain) statement.elevation = std::get<double>(*elevation);
  }
  return statement;
}

Statement read_location(std::vector<InputObject> const& objects) {
  for (auto const& object : objects) {
    if (object.type != site_location::type) continue;
    return naming(object.where(), [&] {
      return Statement{read(object, site_location::latitude),
                       read(object, site_location::longitude),
                       read(object, site_location::elevation)};
    });
  }
  return {};
}

}  // namespace

SiteOrigin find_site_origin(std::vector<InputObject> const& objects) {
  Statement stated;
  std::string first;  // the object that gives it
  for_each_of(objects, field::type, [&](InputObject const& object) {
    auto const statement = read_statement(object);
    if (statement.empty()) return;
    if (!first.empty() && statement != stated) {
      throw Error(
          fmt::format("its origin differs from that of {}: a model has only one origin", first));
    }
    stated = statement;
    if (first.empty()) first = object.title();
  });
  auto const location = read_location(objects);
  SiteOrigin origin;
  origin.source = stated.latitude ? first : "Site:Location";
  auto const latitude = stated.latitude ? stated.latitude : location.latitude;
  auto const longitude = stated.latitude ? stated.longitude : location.longitude;
  auto const elevation = stated.elevation ? stated.elevation : location.elevation;
  if (!latitude || (!elevation && !stated.at_terrain)) {
    throw Error(fmt::format(
        "Site:Location is missing, expected it or a GPUShading:SiteContext with {}, {} and {}",
        field::origin_latitude.title, field::origin_longitude.title,
        field::origin_elevation.title));
  }
  origin.place = {*latitude, *longitude, elevation.value_or(0.0)};
  origin.at_terrain = stated.at_terrain;
  naming(origin.source, [&] { LocalAxes const check(origin.place); });
  return origin;
}

}  // namespace gpu_shading::energyplus
