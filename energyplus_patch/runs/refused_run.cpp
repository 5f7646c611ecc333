#include "runs/refused_run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string_view>
#include <system_error>

#include "gpu_shading/error.h"
#include "model/options/command_line.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/text.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

// What follows the asterisks of a line: "   ** Severe  ** text", "   **   ~~~   ** text".
std::string text_of(std::string const& line) {
  auto const mark = line.rfind("** ");
  return mark == std::string::npos ? trimmed(line) : trimmed(line.substr(mark + 2));
}

std::filesystem::path error_path(CommandLine const& line, std::string_view ending) {
  std::string_view const middle = same_name(line.output_suffix, "L") ? "out" : "";
  return fmt::format("{}{}{}", (line.output_folder / line.output_prefix).string(), middle, ending);
}

// The errors of EnergyPlus's file, in order: "Severe: text" or "Fatal: text".
std::vector<std::string> errors_in(std::filesystem::path const& error_file) {
  std::ifstream file(error_file);
  std::vector<std::string> found;
  bool severe = false;
  for (std::string line; std::getline(file, line);) {
    bool const continued = line.find("**   ~~~   **") != std::string::npos;
    bool const fatal = line.find("**  Fatal") != std::string::npos;
    bool const starts = fatal || line.find("** Severe") != std::string::npos;
    severe = starts || (continued && severe);
    if (!severe) continue;
    if (starts) found.emplace_back(fatal ? "Fatal:" : "Severe:");
    found.back() += ' ' + text_of(line);
  }
  return found;
}

}  // namespace

std::string stop_reasons(std::filesystem::path const& folder) {
  auto const errors = errors_in(folder / "eplusout.err");
  return errors.empty() ? "no reason is given" : fmt::format("{}", fmt::join(errors, "; "));
}

void print_first_error(std::vector<std::string> const& arguments) {
  auto const line = read_command_line(arguments);
  auto const file = error_path(line, ".err");
  auto const errors = errors_in(file);
  // Ours have been printed.
  constexpr std::string_view ours = "gpu_shading: ";
  if (errors.empty() || errors.front().find(ours) != std::string::npos) return;
  print_line(fmt::format("error: {}EnergyPlus stopped: {}; more in {}",
                         line.model ? line.model->filename().string() + ": " : "", errors.front(),
                         file.string()));
}

std::optional<std::string> last_error(std::filesystem::path const& log) {
  constexpr std::string_view mark = "gpu_shading: error: ";
  std::ifstream file(log);
  std::optional<std::string> found;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(mark)) continue;
    if (line.ends_with(':')) line.pop_back();  // a list follows
    found = line.substr(mark.size());
  }
  return found;
}

namespace {

using Path = std::filesystem::path;

// "00hr 00min  0.07sec"
std::string elapsed_text(double seconds) {
  constexpr double minute = 60.0;
  constexpr double hour = 3600.0;
  return fmt::format("{:02.0f}hr {:02.0f}min {:5.2f}sec", std::floor(seconds / hour),
                     std::floor(std::fmod(seconds, hour) / minute), std::fmod(seconds, minute));
}

// The sentence with which EnergyPlus ends both files.
std::string last_line(double seconds) {
  return fmt::format(
      "EnergyPlus Terminated--Fatal Error Detected. 0 Warning; 1 Severe Errors; Elapsed Time={}",
      elapsed_text(seconds));
}

// What an EnergyPlus of that folder begins its files with.
std::string program_version(Path const& installation) {
  std::time_t const now = std::time(nullptr);
  std::tm local{};
  if (std::tm const* const found = std::localtime(&now)) local = *found;
  std::string version = "unknown";
  try {
    version = read_full_version(installation);
  } catch (Error const&) {  // NOLINT(bugprone-empty-catch): that may be why the run is refused
  }
  return fmt::format("EnergyPlus, Version {}, YMD={:%Y.%m.%d %H:%M}", version, local);
}

std::string error_file(Path const& installation, std::string const& error, double seconds) {
  constexpr std::string_view stars = "   ************* ";
  auto const said = "gpu_shading: " + error;
  auto text = fmt::format("Program Version,{},\n", program_version(installation));
  auto const add = [&](std::string_view start, std::string_view line) {
    text += fmt::format("{}{}\n", start, line);
  };
  add("   ** Severe  ** ", said);
  add("   **  Fatal  ** ",
      "gpu_shading: The model was refused before EnergyPlus started. Preceding condition(s) cause "
      "termination.");
  add("   ...", "Summary of Errors that led to program termination:");
  add("   ..... ", "Reference severe error count=1");
  add("   ..... ", "Last severe error=" + said);
  add(stars,
      "Warning:  Node connection errors not checked - most system input has not been read (see "
      "previous warning).");
  add(stars,
      "Fatal error -- final processing.  Program exited before simulations began.  See previous "
      "error messages.");
  for (auto const* const stage : {"Warmup", "Sizing"}) {
    add(stars, fmt::format("EnergyPlus {0} Error Summary. During {0}: 0 Warning; 0 Severe Errors.",
                           stage));
  }
  add(stars, last_line(seconds));
  return text;
}

// Through a link and without a hidden folder beside it: as EnergyPlus would.
void overwrite(Path const& path, std::string const& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw Error(fmt::format("{}: cannot be written ({})", path.string(),
                            std::generic_category().message(errno == 0 ? EIO : errno)));
  }
}

void report(CommandLine const& line, Path const& installation, std::string const& error,
            double seconds) {
  auto const text = error_file(installation, error, seconds);
  std::error_code failure;
  std::filesystem::create_directories(line.output_folder, failure);
  if (failure) {
    throw Error(
        fmt::format("{}: cannot be created ({})", line.output_folder.string(), failure.message()));
  }
  overwrite(error_path(line, ".err"), text);
  overwrite(error_path(line, ".end"), last_line(seconds) + '\n');
}

}  // namespace

void report_refusal(std::vector<std::string> const& arguments, Path const& installation,
                    std::string const& error, std::chrono::duration<double> elapsed) noexcept {
  try {
    auto const line = read_command_line(arguments);
    if (line.runs) report(line, installation, error, elapsed.count());
  } catch (std::exception const& failure) {
    print_line("warning: " + error_line(failure));
  }
}

}  // namespace gpu_shading::energyplus
