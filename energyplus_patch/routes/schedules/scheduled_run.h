#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "routes/run_setup.h"

namespace gpu_shading::energyplus {

// For an EnergyPlus that cannot be patched: sunlit fractions of every timestep are rendered before
// the run and passed as schedules (Shading Calculation Method "Scheduled").
struct ScheduledModel {
  std::filesystem::path path;         // to run in place of the user's
  std::vector<std::string> warnings;  // for EnergyPlus's .err, including the limits of this method
  std::vector<std::string> remarks;   // remarks for the same file
};

// `say` gets every warning and remark immediately. With Mode::off, nothing is rendered: our objects
// are removed and polygon clipping is used.
using Say = std::function<void(std::string const&)>;
ScheduledModel prepare_scheduled(EnergyPlusCall const& call, Choices const& choices,
                                 std::filesystem::path const& folder, Say const& say);

// A whole run of an unmodified EnergyPlus library, with sunlit fractions rendered before it.
// Returns its exit status. Throws Error.
int run_scheduled(std::filesystem::path const& library, RunSetup const& setup);

}  // namespace gpu_shading::energyplus
