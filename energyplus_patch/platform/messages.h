#pragma once

#include <functional>
#include <string>

namespace gpu_shading::energyplus {

// Destinations of messages to the user.
struct Messages {
  std::function<void(std::string const&)> warning;  // to EnergyPlus's .err
  std::function<void(std::string const&)> remark;   // to EnergyPlus's .err, plain
  std::function<void(std::string const&)> eio;      // to EnergyPlus's .eio
};

}  // namespace gpu_shading::energyplus
