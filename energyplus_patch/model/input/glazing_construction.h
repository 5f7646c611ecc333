#pragma once

#include <string>
#include <vector>

#include "gpu_shading/transmittance.h"
#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

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
