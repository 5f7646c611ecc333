#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// What EnergyPlus's surfaces see of the sky behind what shades them, by timestep and hour: arrays
// with three indexes in its SolarShadingData. SkyDifSolarShading sets them to 1, shades the patches
// of the sky, multiplies the surfaces' view factors for long-wave radiation by them, and only then
// gives them their values.
class SkyRatios {
 public:
  // After SkyDifSolarShading; nothing if the arrays are not as expected. `symbols` must have those
  // of Need::long_wave.
  static std::optional<SkyRatios> find(State& state, SymbolTable const& symbols);

  // While it runs again, after the last patch: puts the values where they are still 1, so that the
  // view factors are multiplied by them. Returns false, without a change, if nothing is.
  bool restore() const;

 private:
  struct Array {
    std::byte const* at;  // its header
    std::vector<double> values;
  };
  std::vector<Array> arrays_;
};

}  // namespace gpu_shading::energyplus
