#include "model/reflected_light_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "gpu_shading/error.h"
#include "model/ground_views.h"
#include "model/idf/local_environment.h"
#include "model/input/surrounding_groups.h"
#include "model/input/transparent_shades.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Below it, no schedule could pass light.
constexpr double min_ground_view = 1e-4;
// The ground of a surface that sees none: it needs a view factor to have a reflectance, and
// EnergyPlus refuses a sum over 1.
constexpr double unseen_ground = 1e-17;
constexpr std::string_view view_field = "view_factor_to_ground";

using ObjectsByName = std::unordered_map<std::string, InputObject const*>;

// Adds the objects of a type, of each name the first.
void add_by_name(std::vector<InputObject> const& objects, std::string_view type,
                 ObjectsByName& found) {
  for (auto const& object : objects) {
    if (object.type == type) found.try_emplace(upper(object.name), &object);
  }
}

class Layers {
 public:
  explicit Layers(std::vector<InputObject> const& objects) {
    add_by_name(objects, "Construction", constructions_);
    for (auto const* type : {"Material", "Material:NoMass", "Material:RoofVegetation"}) {
      add_by_name(objects, type, materials_);
    }
  }

  // The outside layer of a surface, if it is one of these materials.
  InputObject const* outside_of(InputObject const& surface) const {
    auto const construction = constructions_.find(upper(surface["construction_name"]));
    if (construction == constructions_.end() || construction->second->list.empty()) return nullptr;
    auto const material = materials_.find(upper(construction->second->list.front()));
    return material == materials_.end() ? nullptr : material->second;
  }

  bool is_green(InputObject const& surface) const {
    auto const* outside = outside_of(surface);
    return outside != nullptr && outside->type == "Material:RoofVegetation";
  }

  double reflectance(InputObject const& surface) const {
    constexpr double default_absorptance = 0.7;
    auto const* outside = outside_of(surface);
    auto const absorptance =
        outside == nullptr ? std::nullopt : parse_number((*outside)["solar_absorptance"]);
    return 1.0 - std::clamp(absorptance.value_or(default_absorptance), 0.0, 1.0);
  }

 private:
  ObjectsByName constructions_;
  ObjectsByName materials_;
};

bool is_opaque_door(InputObject const& object) {
  return object.type == "Door" || (object.type == "FenestrationSurface:Detailed" &&
                                   same_name(object["surface_type"], "Door"));
}

bool is_outdoors(InputObject const& object, ShadingInput const& input) {
  auto const name = upper(object.name);
  return (input.base_of.contains(name) || input.zone_of.contains(name)) &&
         !input.not_exterior.contains(input.base_surface(name)) &&
         !object["construction_name"].empty();
}

std::map<std::string, double> reflectances_of(std::vector<InputObject> const& objects,
                                              ShadingInput const& input, Layers const& layers) {
  std::map<std::string, double> found;
  for (auto const& object : objects) {
    auto const name = upper(object.name);
    if (!is_outdoors(object, input)) continue;
    if (input.base_of.contains(name) && !is_opaque_door(object)) continue;
    found.try_emplace(name, layers.reflectance(object));
  }
  return found;
}

// As ReflectedLight has them. `black`: gets the surfaces whose glazing cannot be interpreted.
std::map<std::string, double> mirrors_of(std::vector<InputObject> const& objects,
                                         ShadingInput const& input,
                                         std::vector<std::string>& black) {
  std::unordered_map<std::string, std::optional<double>> by_construction;
  auto const reflectance = [&](std::string const& construction) {
    auto const [entry, added] = by_construction.try_emplace(construction);
    try {
      if (added) entry->second = construction_reflectance(objects, construction);
    } catch (Error const&) {
    }
    return entry->second;
  };
  std::map<std::string, double> found;
  auto const add = [&](std::string const& name, std::string const& construction) {
    if (auto const glass = reflectance(construction)) {
      found.try_emplace(name, *glass);
    } else {
      black.push_back(name);
    }
  };
  for (auto const& object : objects) {
    auto const name = upper(object.name);
    if (!input.base_of.contains(name) || is_opaque_door(object)) continue;
    if (is_outdoors(object, input)) add(name, upper(object["construction_name"]));
  }
  for (auto const& [name, shade] : input.shading_surfaces) {
    if (shade.glazed > 0.0) add(name, shade.glazing);
  }
  return found;
}

// `black`: as mirrors_of() has it.
ReflectedLight reflectors_of(std::vector<InputObject> const& objects, ShadingInput const& input,
                             Layers const& layers, std::vector<std::string>& black) {
  ReflectedLight light;
  light.reflectances = reflectances_of(objects, input, layers);
  light.mirrors = mirrors_of(objects, input, black);
  return light;
}

// The surfaces' own local environments.
class Environments {
 public:
  void add(std::vector<InputObject> const& objects) {
    add_by_name(objects, "SurfaceProperty:SurroundingSurfaces", surroundings_);
    add_by_name(objects, "SurfaceProperty:GroundSurfaces", grounds_);
    for (auto const& object : objects) {
      if (object.type != local_environment) continue;
      auto const [entry, added] =
          environments_.try_emplace(upper(object["exterior_surface_name"]), &object);
      if (!added || object.name.empty()) entry->second = nullptr;
    }
  }

  bool has(std::string const& surface) const { return environments_.contains(surface); }

  // Nothing if the surface has several, or one without a name.
  InputObject const* of(std::string const& surface) const { return environments_.at(surface); }

  // The ground that the environment has for long-wave exchange; `view`: that of a surface without
  // one. Nothing if it cannot be replaced by a ground with a reflectance.
  std::optional<GroundSurface> ground(InputObject const& environment, double view) const {
    auto const& ground = environment["ground_surfaces_object_name"];
    if (!ground.empty()) return ground_of_views(upper(ground));
    auto const& surroundings = environment["surrounding_surfaces_object_name"];
    if (surroundings.empty()) return GroundSurface{view};
    auto const found = surroundings_.find(upper(surroundings));
    if (found == surroundings_.end()) return std::nullopt;
    auto const given = parse_number((*found->second)["ground_view_factor"]);
    if (!given) return std::nullopt;
    return GroundSurface{*given, (*found->second)["ground_temperature_schedule_name"]};
  }

 private:
  // That of --gpu-shading-surroundings, which has no reflectance.
  std::optional<GroundSurface> ground_of_views(std::string const& name) const {
    enum Field { title, view, temperature, reflectance, count };
    auto const found = grounds_.find(name);
    if (found == grounds_.end() || !name.starts_with(views_of)) return std::nullopt;
    auto list = found->second->list;
    list.resize(std::max<std::size_t>(list.size(), count));
    auto const given = parse_number(list[view]);
    if (list.size() > count || !given || !list[reflectance].empty()) return std::nullopt;
    return GroundSurface{*given, list[temperature]};
  }

  std::unordered_map<std::string, InputObject const*> environments_;  // by surface
  ObjectsByName surroundings_;
  ObjectsByName grounds_;
};

// Names of new objects that are in no field of the model.
struct NewNames {
  std::string limits;  // of the schedules: EnergyPlus warns of each one without
  std::string prefix;
};
NewNames free_names(std::map<std::string, ExposedSurface> const& surfaces,
                    MentionFinder const& find_mentions) {
  for (int number = 1;; ++number) {
    auto const limits = number == 1 ? std::string("GPU SHADING GROUND")
                                    : fmt::format("GPU SHADING GROUND {}", number);
    auto const prefix = limits + " OF ";
    Names names{limits};
    for (auto const& [name, surface] : surfaces) names.insert(prefix + name);
    if (!find_mentions || find_mentions(names).empty()) return {limits, prefix};
  }
}

enum class Kept {
  unreadable,
  dome,
  typed_view,
  flat,
  green,
  environment,
};

std::string_view reason_of(Kept kept) {
  switch (kept) {
    case Kept::unreadable:
      return "tilt in EnergyPlus unknown";
    case Kept::dome:
      return "tubular daylighting";
    case Kept::typed_view:
      return "View Factor to Ground is not (1 - cos(tilt)) / 2";
    case Kept::flat:
      return "facing up, and without the field View Factor to Ground";
    case Kept::green:
      return "Material:RoofVegetation";
    case Kept::environment:
      return "SurfaceProperty:LocalEnvironment with a ground of its own";
  }
  return {};
}

class InputMaker {
 public:
  InputMaker(std::vector<InputObject> const& objects, std::vector<InputObject> const& more,
             ShadingInput const& input, MentionFinder const& find_mentions)
      : layers_(objects), surfaces_(exposed_surfaces(objects)) {
    environments_.add(objects);
    environments_.add(more);
    made_.light = reflectors_of(objects, input, layers_, black_);
    names_ = free_names(surfaces_, find_mentions);
  }

  ReflectedLightInput make() {
    for (auto const& [name, surface] : surfaces_) {
      if (auto const kept = add(name, surface)) kept_[*kept].push_back(name);
    }
    constexpr std::size_t max_names = 5;
    if (!black_.empty()) {
      made_.remarks.push_back(
          fmt::format("glass that is not of WindowMaterial:Glazing with SpectralAverage or "
                      "WindowMaterial:SimpleGlazingSystem reflects nothing: {}",
                      listed(black_, max_names)));
    }
    for (auto const& [kept, names] : kept_) {
      made_.remarks.push_back(fmt::format(
          "EnergyPlus's own light from the ground is kept for {} surface{} ({}): {}", names.size(),
          names.size() == 1 ? "" : "s", reason_of(kept), listed(names, max_names)));
    }
    return std::move(made_);
  }

 private:
  // Returns why EnergyPlus's own light stays, if it does.
  std::optional<Kept> add(std::string const& name, ExposedSurface const& surface) {
    auto const& object = *surface.object;
    if (same_name(object["surface_type"], "TubularDaylightDome")) return Kept::dome;
    if (same_name(object["surface_type"], "TubularDaylightDiffuser")) return Kept::dome;
    if (!(surface.ground_view >= 0.0)) return Kept::unreadable;
    if (layers_.is_green(object)) return Kept::green;
    auto view = surface.ground_view;
    if (auto const& text = object[view_field]; !text.empty() && !same_name(text, "Autocalculate")) {
      constexpr double tolerance = 0.01;
      auto const typed = parse_number(text);
      if (!typed || std::abs(*typed - view) > tolerance) return Kept::typed_view;
      view = *typed;
    }
    bool const unseen = view < min_ground_view;
    bool const has_field = find_type(object.type)->has(view_field);
    if (unseen && !has_field) return Kept::flat;
    auto const receiver = names_.prefix + name;
    GroundSurface ground{surface.ground_view};
    if (environments_.has(name)) {
      auto const* environment = environments_.of(name);
      if (environment == nullptr) return Kept::environment;
      auto const own = environments_.ground(*environment, surface.ground_view);
      if (!own) return Kept::environment;
      ground = *own;
      made_.changes.push_back({local_environment, environment->name,
                               position_of(local_environment, "ground_surfaces_object_name"),
                               receiver});
    } else {
      made_.added.push_back(
          environment_object({.name = receiver, .surface = object.name, .ground = receiver}));
    }
    if (unseen) {
      made_.changes.push_back(
          {find_type(object.type)->type, object.name, position_of(object.type, view_field), 1.0});
    }
    ground.view = std::max(ground.view, unseen_ground);
    ground.reflectance_schedule = receiver;
    made_.added.push_back(ground_object(receiver, ground));
    if (made_.light.receivers.empty()) {
      made_.added.push_back({"ScheduleTypeLimits", {{"name", names_.limits}}});
      made_.light.schedule_limits = names_.limits;
    }
    made_.light.receivers.push_back({name, receiver, unseen ? 1.0 : view});
    return std::nullopt;
  }

  Layers layers_;
  Environments environments_;
  std::map<std::string, ExposedSurface> surfaces_;
  NewNames names_;
  std::map<Kept, std::vector<std::string>> kept_;
  std::vector<std::string> black_;
  ReflectedLightInput made_;
};

}  // namespace

ReflectedLight read_reflectors(std::vector<InputObject> const& objects, ShadingInput const& input) {
  std::vector<std::string> black;
  return reflectors_of(objects, input, Layers(objects), black);
}

ReflectedLightInput read_reflected_light(std::vector<InputObject> const& objects,
                                         std::vector<InputObject> const& more,
                                         ShadingInput const& input,
                                         MentionFinder const& find_mentions) {
  return InputMaker(objects, more, input, find_mentions).make();
}

std::vector<NewObject> constant_schedules(ReflectedLight const& light) {
  std::vector<NewObject> schedules;
  for (auto const& receiver : light.receivers) {
    schedules.push_back({"Schedule:Constant",
                         {{"name", receiver.schedule},
                          {"schedule_type_limits_name", light.schedule_limits},
                          {"hourly_value", min_ground_reflectance}}});
  }
  return schedules;
}

}  // namespace gpu_shading::energyplus
