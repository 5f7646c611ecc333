#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/beam_filter.h"
#include "gpu_shading/transmittance.h"
#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// The GPUShading:TransparentShade of a surface.
struct TransparentShade {
  std::string object;       // its name
  std::string description;  // e.g. "transparent (construction Double Clear)"
  FilterFactor solar;
  FilterFactor visible;  // for light; may share its model with `solar`
  bool glass = false;
};

struct TransparentShades {
  std::map<std::string, TransparentShade> by_surface;  // upper-case names
  std::vector<std::string> warnings;
};

// Reads every GPUShading:TransparentShade of a model. `folder`: where relative file names start.
// Throws Error, naming object, field and value, for a pattern that matches no shading surface, a
// surface named twice, a transmittance model that is invalid or leaves 0 .. 1, or a construction or
// material that cannot be used.
TransparentShades read_transparent_shades(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          std::filesystem::path const& folder);

// Gives a filter to the shading surfaces whose names match a pattern. Throws Error, with a field's
// title, if there are none, or one of them has a filter.
void add_filter(std::string_view field, std::string const& pattern, TransparentShade const& filter,
                ShadingInput const& input, TransparentShades& shades);

// For solar radiation and for light.
struct GlazingTransmittance {
  Transmittance solar;
  Transmittance visible;
};

// Beam transmittances of a Construction of WindowMaterial:Glazing, :Gas, :GasMixture or
// :SimpleGlazingSystem layers, as EnergyPlus computes them for a window of that construction. Where
// a material gives no visible transmittance, it is the solar one.
// `warnings` gets a line for each material that scatters light, because only the undeviated beam is
// modelled. Throws Error, naming construction, material, field and value.
GlazingTransmittance construction_transmittance(std::vector<InputObject> const& objects,
                                                std::string const& construction,
                                                std::vector<std::string>& warnings);

// Solar reflectance of such a construction's outside at normal incidence, 0 .. 1. Throws Error as
// construction_transmittance() does.
double construction_reflectance(std::vector<InputObject> const& objects,
                                std::string const& construction);

}  // namespace gpu_shading::energyplus
