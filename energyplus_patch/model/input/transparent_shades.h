#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/transmittance.h"
#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// The GPUShading:TransparentShade of a surface.
struct TransparentShade {
  std::string object;                                  // its name
  std::string description;                             // e.g. "construction Double Clear"
  std::shared_ptr<Transmittance const> transmittance;  // for solar radiation
  std::shared_ptr<Transmittance const> visible;        // for light; may be the same object
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

}  // namespace gpu_shading::energyplus
