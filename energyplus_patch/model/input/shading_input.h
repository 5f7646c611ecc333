#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// An object of EnergyPlus whose fields have another position or name from a release on.
struct ChangedObject {
  std::string_view type;
  std::string_view release;
};

// What the shading calculation needs from a model besides the polygons that EnergyPlus passes.
// Names are in upper case, as in EnergyPlus, except for the suffixes that EnergyPlus itself adds.
struct ShadingInput {
  struct ShadingSurface {
    std::string type;
    std::string transmittance_schedule = {};  // or ""
    // ShadingProperty:Reflectance, with EnergyPlus's defaults: the diffuse reflectances for solar
    // radiation and for light, 0 .. 1, of the part that is not glazed, and the glazed fraction, 0
    // .. 1.
    double reflectance = 0.2;
    double visible_reflectance = 0.2;
    double glazed = 0.0;
    std::string glazing = {};  // construction of the glazed part, or ""
  };

  std::string version;                         // version of the input, e.g. "9.6"
  std::vector<ChangedObject> changed_objects;  // objects that are given and whose fields changed
  std::string shading_method;                  // as written, or ""
  std::optional<int> pixel_counting_resolution;
  bool every_timestep = false;  // Shading Calculation Update Frequency Method
  int update_days = 20;         // ... Update Frequency: of Periodic
  bool detailed_sky = false;    // Sky Diffuse Modeling Algorithm

  bool minimal_shadowing = false;       // Building: Solar Distribution
  bool reflections = false;             // ... WithReflections
  bool disable_within_groups = false;   // ShadowCalculation: Disable Self-Shading ...
  bool disable_between_groups = false;  //
  std::vector<std::string> shading_zone_groups;
  std::map<std::string, std::set<std::string>> zone_lists;

  std::map<std::string, std::string> zone_of;  // base surface -> zone
  std::map<std::string, std::string> base_of;  // window or door -> base surface
  std::set<std::string> not_exterior;          // base surfaces that are not exposed to the outdoors
  std::map<std::string, ShadingSurface> shading_surfaces;  // by EnergyPlus's names

  std::set<std::string> actuated;  // names in EMS actuators, including schedules

  // Shading surfaces and mirrored copies (mirrored_name) whose own sunlit fraction is used: by an
  // output, an EMS sensor, photovoltaics, a collector or a daylighting shelf; all of them with the
  // external shading file, or if an output's key cannot be interpreted.
  std::set<std::string> wanted_shading;
  bool all_shading_wanted = false;
  std::string unreadable_key;  // the output and why, or ""

  // An output shows sunlit fractions, or what depends on them, of all surfaces, mirrored copies
  // among them: with the key *, or in a table.
  bool all_surfaces_shown = false;

  // As in PolygonClipping: shading surfaces and reveals always cast; walls and roofs exposed to the
  // outdoors cast while they face away from the sun; other surfaces (interzone, adiabatic, ground
  // contact), windows and doors never cast.
  Casting casting(std::string const& surface) const;

  // Whether an output shows the sunlit fraction of a mirrored copy.
  bool mirrored_shown() const;

  // Whether an object of the model uses a shading surface's own sunlit fraction.
  bool names(std::string const& shading_surface) const {
    return all_shading_wanted || wanted_shading.contains(shading_surface);
  }

  // The same, or whether EnergyPlus itself needs those of all that it knows: for solar reflections,
  // or for an output of all surfaces.
  bool wants(std::string const& shading_surface) const {
    return reflections || all_surfaces_shown || names(shading_surface);
  }

  // The base surface of a window or door; any other surface is its own.
  std::string base_surface(std::string const& surface) const;

  // Whether EnergyPlus may ask for the surface's sunlit area and uses it.
  bool receives(std::string const& surface) const;
};

// For the field of an object whose name or pattern no shading surface matches: the error says what
// the name is instead, or which one is near it.
Error no_shading_surface(std::string_view field, std::string const& pattern,
                         ShadingInput const& input);

// EnergyPlus's name of the copy of a shading surface that faces the other way.
std::string mirrored_name(std::string const& shading_surface);
bool is_mirrored(std::string const& surface);

// Whether an object is an output of surfaces ("Surface ...").
bool is_surface_output(InputObject const& object);

// Throws Error for an invalid value.
ShadingInput read_shading_input(std::vector<InputObject> const& objects);

// The EnergyPlus that reads a model.
struct Release {
  std::string version;  // e.g. "9.6.0"
  std::string updater;  // the program that updates models, or where to get it
};

// Throws Error for models that this module must not handle: with user-defined sunlit fractions
// (Scheduled, Imported), or of an earlier version in which an object that decides on shading had
// other fields. Returns a warning if the model is of another version, which EnergyPlus reads as its
// own, or "". `file` is the model's, for messages.
std::string check_supported(ShadingInput const& input, std::string_view file,
                            Release const& energyplus);

}  // namespace gpu_shading::energyplus
