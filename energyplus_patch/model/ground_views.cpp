#include "model/ground_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <string_view>

#include "gpu_shading/error.h"
#include "model/geometry_rules.h"
#include "model/site/farthest_coordinate.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <std::size_t count>
bool is_one_of(std::string_view type, std::array<std::string_view, count> const& types) {
  return std::ranges::find(types, type) != types.end();
}

bool is_detailed(InputObject const& object) {
  constexpr std::array<std::string_view, 4> types{"BuildingSurface:Detailed", "Wall:Detailed",
                                                  "RoofCeiling:Detailed", "Floor:Detailed"};
  return is_one_of(object.type, types);
}

bool is_simple(InputObject const& object) {
  return object.type == "Wall:Exterior" || object.type == "Roof";
}

bool is_opening(InputObject const& object) {
  constexpr std::array<std::string_view, 4> types{"FenestrationSurface:Detailed", "Window",
                                                  "GlazedDoor", "Door"};
  return is_one_of(object.type, types);
}

bool is_exposed(InputObject const& object) {
  if (is_simple(object)) return true;
  auto const& sun = object["sun_exposure"];
  return is_detailed(object) && same_name(object["outside_boundary_condition"], "Outdoors") &&
         (sun.empty() || same_name(sun, "SunExposed"));
}

double view_of_cosine(double cosine) {
  // EnergyPlus takes nearly vertical and horizontal surfaces for exactly so.
  constexpr double rounding = 1e-6;
  for (double const exact : {-1.0, 0.0, 1.0}) {
    if (std::abs(cosine - exact) < rounding) cosine = exact;
  }
  return (1.0 - cosine) / 2.0;
}

// EnergyPlus turns roofs and floors that face the wrong way.
bool may_be_turned(InputObject const& object, double z) {
  auto const& kind = object["surface_type"];
  bool const floor = object.type == "Floor:Detailed" || same_name(kind, "Floor");
  bool const roof = object.type == "RoofCeiling:Detailed" || same_name(kind, "Roof") ||
                    same_name(kind, "Ceiling");
  return (floor && z > 0.0) || (roof && z < 0.0);
}

// What changes the tilt of a sloped surface.
struct Geometry {
  bool clockwise = false;
  bool stretched = false;
};

double view_of_vertices(InputObject const& object, Geometry const& geometry) {
  auto const ring = vertices_of(object);
  if (!ring || !std::ranges::all_of(*ring, is_within_reach)) return unknown;
  auto const facing = normal({*ring, {}});
  if (facing == glm::dvec3(0.0)) return unknown;
  double const z = geometry.clockwise ? -facing.z : facing.z;
  double const view = view_of_cosine(z);
  bool const sloped = view != 0.0 && view != 0.5 && view != 1.0;
  return may_be_turned(object, z) || (geometry.stretched && sloped) ? unknown : view;
}

double view_of_angle(InputObject const& object) {
  auto const& text = object["tilt_angle"];
  constexpr double upright = 90.0;
  constexpr double upside_down = 180.0;
  auto const tilt =
      text.empty() ? (object.type == "Roof" ? 0.0 : upright) : parse_number(text).value_or(-1.0);
  if (!(tilt >= 0.0 && tilt <= upside_down)) return unknown;
  return view_of_cosine(std::cos(glm::radians(tilt)));
}

std::optional<Geometry> geometry_of(std::vector<InputObject> const& objects) {
  try {
    return Geometry{read_geometry_rules(objects).clockwise, !warn_of_transform(objects).empty()};
  } catch (Error const&) {
    return std::nullopt;
  }
}

}  // namespace

std::map<std::string, ExposedSurface> exposed_surfaces(std::vector<InputObject> const& objects) {
  std::map<std::string, ExposedSurface> found;
  auto const geometry = geometry_of(objects);
  if (!geometry) return found;
  std::map<std::string, int> count;
  for (auto const& object : objects) {
    bool const wall = is_detailed(object) || is_simple(object);
    if (!wall && !is_opening(object)) continue;
    auto const name = upper(object.name);
    ++count[name];
    if (!wall || !is_exposed(object)) continue;
    found[name] = {&object,
                   is_simple(object) ? view_of_angle(object) : view_of_vertices(object, *geometry)};
  }
  for (auto const& object : objects) {
    if (!is_opening(object) || !object["outside_boundary_condition_object"].empty()) continue;
    auto const wall = found.find(upper(object["building_surface_name"]));
    if (wall == found.end() || !is_exposed(*wall->second.object)) continue;
    bool const detailed = object.type == "FenestrationSurface:Detailed";
    found[upper(object.name)] = {
        &object, detailed ? view_of_vertices(object, *geometry) : wall->second.ground_view};
  }
  for (auto const& [name, objects_of_name] : count) {
    if (name.empty() || objects_of_name > 1) found.erase(name);
  }
  return found;
}

}  // namespace gpu_shading::energyplus
