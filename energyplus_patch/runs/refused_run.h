#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Why a run stopped, from the eplusout.err in its folder: "Severe: ...; Fatal: ...".
std::string stop_reasons(std::filesystem::path const& folder);

// Prints the first error in the .err file of a run with these arguments, EnergyPlus's own without
// the program's name, unless it is ours, which has been printed.
void print_first_error(std::vector<std::string> const& arguments);

// Our last error in what a run has printed, without "gpu_shading: error: ".
std::optional<std::string> last_error(std::filesystem::path const& log);

// For programs that start EnergyPlus and read its files, not its standard error: writes
// eplusout.err and eplusout.end about a run that was refused before EnergyPlus started, with the
// names, in the folder and in the format of an EnergyPlus that stops on its input. As there, files
// of an earlier run with these names are overwritten and all others are left alone. Writes nothing
// if the arguments, EnergyPlus's own without the program's name, ask for no run. Prints a warning
// if the files cannot be written.
// `installation`: the folder of Energy+.idd. `elapsed`: since the program started.
void report_refusal(std::vector<std::string> const& arguments,
                    std::filesystem::path const& installation, std::string const& error,
                    std::chrono::duration<double> elapsed) noexcept;

}  // namespace gpu_shading::energyplus
