#include "site/weather_site.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "base/files.h"
#include "base/text.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

double number(std::filesystem::path const& weather, std::string const& text, std::string_view field,
              double most) {
  auto const value = parse_number(text);
  if (!value || !(std::abs(*value) <= most)) {
    throw Error(fmt::format("{}: LOCATION: {} is {}, expected a number from {} to {}",
                            weather.string(), field, in_quotes(text), -most, most));
  }
  return *value;
}

}  // namespace

WeatherSite read_weather_site(std::filesystem::path const& weather) {
  require_file(weather);
  std::ifstream file(weather);
  std::string line;
  if (!file || !std::getline(file, line)) {
    throw Error(fmt::format("{}: cannot be read", weather.string()));
  }
  auto const fields = comma_separated(line);
  constexpr std::size_t all = 10;
  if (fields.size() < all || !same_name(fields.front(), "LOCATION")) {
    throw Error(
        fmt::format("{}: expected a weather file (EPW), with LOCATION and nine more fields "
                    "in its first line",
                    weather.string()));
  }
  return {fields[1], number(weather, fields[6], "latitude", 90.0),
          number(weather, fields[7], "longitude", 180.0),
          number(weather, fields[8], "time zone", 14.0),
          number(weather, fields[9], "elevation", 10000.0)};
}

}  // namespace gpu_shading::energyplus
