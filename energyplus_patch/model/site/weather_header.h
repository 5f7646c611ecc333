#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace gpu_shading::energyplus {

// For the option -w, which errors name. Throws Error like require_file(), and for a file that
// EnergyPlus cannot take as a weather file: without LOCATION at the start of one of its first eight
// lines.
void require_weather(std::filesystem::path const& weather);

// From the first eight lines of a weather file (EPW). The functions throw Error like
// require_file(), or "FILE: LINE: FIELD is VALUE, expected ..."; these lines may have 1 MiB in all.

// The location, from which EnergyPlus computes the sun's path in run periods.
struct WeatherSite {
  std::string name;
  double latitude = 0.0;   // degrees, north positive
  double longitude = 0.0;  // degrees, east positive
  double time_zone = 0.0;  // hours from universal time
  double elevation = 0.0;  // m
};

// Reads LOCATION, which must be the first line.
WeatherSite read_weather_site(std::filesystem::path const& weather);

// Reads HOLIDAYS/DAYLIGHT SAVINGS: the first and the last day of daylight saving time, as
// date_in() takes them. None if the file has no such days.
std::optional<std::pair<std::string, std::string>> read_daylight_saving(
    std::filesystem::path const& weather);

}  // namespace gpu_shading::energyplus
