#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "options/options.h"
#include "scheduled/short_runs.h"
#include "scheduled/sunlit_table.h"

namespace gpu_shading::energyplus {

// For an EnergyPlus that cannot be patched: sunlit fractions of every timestep are rendered before
// the run, and go in as schedules (Shading Calculation Method "Scheduled").
struct ScheduledModel {
  std::filesystem::path path;         // to run in place of the user's
  std::vector<std::string> warnings;  // for EnergyPlus's .err; what this road cannot do is one
  std::vector<std::string> remarks;   // the same, plain
};

// `say` gets every warning and remark as it comes. With Mode::off nothing is rendered: our objects
// are taken out and polygon clipping answers.
using Say = std::function<void(std::string const&)>;
ScheduledModel prepare_scheduled(EnergyPlusCall const& call, Choices const& choices,
                                 std::filesystem::path const& folder, Say const& say);

// The fractions alone. Throws Error where the model has no run period.
SunlitTable sunlit_fractions(EnergyPlusCall const& call, Choices const& choices, Say const& say);

}  // namespace gpu_shading::energyplus
