#include "model/site/weather_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "model/site/site_clock.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<std::string> header_of(std::filesystem::path const& weather) {
  constexpr std::size_t header_lines = 8;
  constexpr std::size_t max_bytes = std::size_t{1} << 20U;
  require_file(weather);
  std::ifstream file(weather, std::ios::binary);
  std::string start(max_bytes, '\0');
  if (!file || file.read(start.data(), max_bytes).bad()) {
    throw Error(fmt::format("{}: cannot be read", weather.string()));
  }
  start.resize(static_cast<std::size_t>(file.gcount()));
  std::istringstream text(start);
  std::vector<std::string> lines;
  for (std::string line; lines.size() < header_lines && std::getline(text, line);) {
    if (text.eof() && start.size() == max_bytes) {
      throw Error(
          fmt::format("{}: its first {} lines are longer than 1 MiB, expected a weather file (EPW)",
                      weather.string(), header_lines));
    }
    lines.push_back(line);
  }
  return lines;
}

double number(std::string const& text, std::string_view field, double max_size) {
  auto const value = parse_number(text);
  if (!value || !(std::abs(*value) <= max_size)) {
    throw Error(fmt::format("{} is {}, expected a number from {} to {}", field, in_quotes(text),
                            -max_size, max_size));
  }
  return *value;
}

// The names of files from NREL have several.
std::string with_single_spaces(std::string text) {
  auto const end =
      std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; });
  text.erase(end, text.end());
  return text;
}

}  // namespace

void require_weather(std::filesystem::path const& weather) try {
  auto const lines = header_of(weather);
  auto const is_location = [](std::string const& line) {
    return upper(trimmed(line)).starts_with("LOCATION");
  };
  if (std::ranges::any_of(lines, is_location)) return;
  bool const zip = !lines.empty() && lines.front().starts_with("PK\x03\x04");
  throw Error(
      fmt::format("{}: {}", weather.string(),
                  zip ? "is a ZIP archive; expected the weather file (.epw) in it: unpack it"
                      : "is not a weather file (.epw), which begins with LOCATION"));
} catch (Error const& error) {
  throw Error(fmt::format("-w {}", error.what()));
}

WeatherSite read_weather_site(std::filesystem::path const& weather) {
  auto const lines = header_of(weather);
  auto const fields = comma_separated(lines.empty() ? "" : lines.front());
  constexpr std::size_t all = 10;
  if (fields.size() < all || !same_name(fields.front(), "LOCATION")) {
    throw Error(
        fmt::format("{}: expected a weather file (EPW), with LOCATION and nine more fields "
                    "in its first line",
                    weather.string()));
  }
  return naming(weather.string() + ": LOCATION", [&] {
    return WeatherSite{with_single_spaces(fields[1]), number(fields[6], "latitude", 90.0),
                       number(fields[7], "longitude", 180.0), number(fields[8], "time zone", 14.0),
                       number(fields[9], "elevation", 10000.0)};
  });
}

std::optional<std::pair<std::string, std::string>> read_daylight_saving(
    std::filesystem::path const& weather) {
  for (auto const& line : header_of(weather)) {
    // Its name, whether it has a leap year, first day, last day; 0 for none.
    auto fields = comma_separated(line);
    fields.resize(4);
    if (!upper(fields[0]).starts_with("HOLIDAYS/DAYLIGHT SAVING")) continue;
    if (fields[2].find_first_not_of('0') == std::string::npos) return {};
    naming(weather.string() + ": " + fields[0], [&] {
      using namespace std::chrono_literals;
      constexpr auto common_year = 2017y;
      date_in(fields[2], common_year);
      date_in(fields[3], common_year);
    });
    return std::pair(fields[2], fields[3]);
  }
  return {};
}

}  // namespace gpu_shading::energyplus
