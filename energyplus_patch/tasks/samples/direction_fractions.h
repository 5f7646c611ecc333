#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// Sunlit fractions of all receivers, as if the sun stood in each of some directions, with schedules
// at their lowest value and screens fully deployed, and the file that they are written to.
struct DirectionsRequest {
  std::vector<SunDirection> directions;
  std::filesystem::path file;

  bool operator==(DirectionsRequest const&) const = default;
};

struct ReceiverFractions {
  SampledReceiver receiver;
  std::vector<double> fractions;  // by direction, 0 .. 1; 0 if it is behind the receiver
};

// On their way from the process that runs EnergyPlus. Throw Error if the file cannot be read or
// written.
void write_fractions(std::filesystem::path const& file,
                     std::vector<ReceiverFractions> const& receivers);
std::vector<ReceiverFractions> read_fractions(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
