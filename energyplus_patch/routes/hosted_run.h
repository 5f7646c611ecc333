#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Messages for a run's .err, from the beginning of its first environment on.
struct RunMessages {
  std::vector<std::string> warnings;
  std::vector<std::string> remarks;
};

// Runs an unpatched EnergyPlus library through its C API. `arguments`: EnergyPlus's own, without
// the program. `messages` are written with our prefix. Returns EnergyPlus's exit status. Throws
// Error if the library lacks the API.
int run_hosted(std::filesystem::path const& library, std::vector<std::string> const& arguments,
               RunMessages const& messages);

// For what EnergyPlus calls during such a run, on its thread: write a line into its .err. Without a
// run they do nothing.
void warn_hosted_run(std::string const& line);
void tell_hosted_run(std::string const& line);

// The day that EnergyPlus is computing.
struct HostedDay {
  int month = 0;
  int day = 0;
  int day_of_year = 0;
  std::string type;  // "Sunday", "SummerDesignDay", ...
};

// Of such a run; nothing without one.
std::optional<HostedDay> hosted_day();

}  // namespace gpu_shading::energyplus
