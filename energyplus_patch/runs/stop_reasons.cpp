#include "runs/stop_reasons.h"

#include <fstream>
#include <string_view>

#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// What follows the asterisks of a line: "   ** Severe  ** text", "   **   ~~~   ** text".
std::string text_of(std::string const& line) {
  auto const mark = line.rfind("** ");
  return mark == std::string::npos ? trimmed(line) : trimmed(line.substr(mark + 2));
}

}  // namespace

std::string stop_reasons(std::filesystem::path const& folder) {
  std::ifstream file(folder / "eplusout.err");
  std::string found;
  bool severe = false;
  for (std::string line; std::getline(file, line);) {
    bool const continued = line.find("**   ~~~   **") != std::string::npos;
    bool const fatal = line.find("**  Fatal") != std::string::npos;
    bool const starts = fatal || line.find("** Severe") != std::string::npos;
    severe = starts || (continued && severe);
    if (!severe) continue;
    if (starts) found += fatal ? "; Fatal:" : "; Severe:";
    found += ' ';
    found += text_of(line);
  }
  return found.empty() ? "no reason is given" : found.substr(2);
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

}  // namespace gpu_shading::energyplus
