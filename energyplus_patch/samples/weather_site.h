#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// Where a weather file is from. EnergyPlus has the sun's path of run periods from there.
struct WeatherSite {
  std::string name;
  double latitude = 0.0;   // degrees, north positive
  double longitude = 0.0;  // degrees, east positive
  double time_zone = 0.0;  // hours from universal time
  double elevation = 0.0;  // m
};

// The first line of an EPW file. Throws Error, naming the field.
WeatherSite read_weather_site(std::filesystem::path const& weather);

}  // namespace gpu_shading::energyplus
