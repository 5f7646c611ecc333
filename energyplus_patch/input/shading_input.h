#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/input_object.h"

namespace gpu_shading::energyplus {

// What the shading calculation must know of a model beyond the polygons that EnergyPlus hands over.
// Names are upper case, as EnergyPlus has them, but for the ends of those that it makes itself.
struct ShadingInput {
  struct ShadingSurface {
    std::string type;
    std::string transmittance_schedule;  // or ""
  };

  std::string version;         // of the input, e.g. "25.2"
  std::string shading_method;  // as written, or ""
  std::optional<int> pixel_counting_resolution;
  bool every_timestep = false;  // Shading Calculation Update Frequency Method

  bool minimal_shadowing = false;       // Building: Solar Distribution
  bool reflections = false;             // ... WithReflections
  bool disable_within_groups = false;   // ShadowCalculation: Disable Self-Shading ...
  bool disable_between_groups = false;  //
  std::vector<std::string> shading_zone_groups;
  std::map<std::string, std::set<std::string>> zone_lists;

  std::map<std::string, std::string> zone_of;  // base surface -> zone
  std::map<std::string, std::string> base_of;  // window or door -> base surface
  std::set<std::string> not_exterior;          // base surfaces with no outdoors outside
  std::map<std::string, ShadingSurface>
      shading_surfaces;  // by the names that EnergyPlus gives them

  std::set<std::string> actuated;  // what EMS actuators name, schedules among them

  // Shading surfaces whose own sunlit fraction has a use: named by an output, an EMS sensor,
  // photovoltaics, a collector or a daylighting shelf; all of them with reflections or with the
  // external shading file.
  std::set<std::string> wanted_shading;
  bool all_shading_wanted = false;

  // As PolygonClipping has it: shading surfaces and reveals always; walls and roofs with outdoors
  // outside while turned away from the sun; others (between zones, adiabatic, in the ground),
  // windows and doors never.
  Casting casting(std::string const& surface) const;

  bool wants(std::string const& shading_surface) const {
    return all_shading_wanted || wanted_shading.contains(shading_surface);
  }

  // The one that a window or door lies in; any other surface is its own.
  std::string base_surface(std::string const& surface) const;

  // Whether EnergyPlus may ask for the surface's sunlit area and has a use for it.
  bool receives(std::string const& surface) const;
};

// Throws Error where a value cannot be understood.
ShadingInput read_shading_input(std::vector<InputObject> const& objects);

// Refuses what this module must not touch: another version of the input, user-given fractions
// (Scheduled, Imported). `version` is EnergyPlus's own, e.g. "25.2.0". Throws Error.
void check_supported(ShadingInput const& input, std::string_view version);

}  // namespace gpu_shading::energyplus
