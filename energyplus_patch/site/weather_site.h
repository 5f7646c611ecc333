#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// The location in a weather file, from which EnergyPlus computes the sun's path in run periods.
struct WeatherSite {
  std::string name;
  double latitude = 0.0;   // degrees, north positive
  double longitude = 0.0;  // degrees, east positive
  double time_zone = 0.0;  // hours from universal time
  double elevation = 0.0;  // m
};

// Reads the first line of an EPW file. Throws Error, naming the field.
WeatherSite read_weather_site(std::filesystem::path const& weather);

}  // namespace gpu_shading::energyplus
