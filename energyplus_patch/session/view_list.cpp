#include "session/view_list.h"

#include <fmt/format.h>

#include <fstream>
#include <glm/trigonometric.hpp>
#include <sstream>

#include "files/whole_file.h"
#include "gpu_shading/error.h"
#include "input/naming.h"

namespace gpu_shading::energyplus {
namespace {

View read_view(std::string const& line, std::string const& place) {
  std::istringstream words(line);
  double azimuth = 0.0;
  double altitude = 0.0;
  View view;
  if (!(words >> view.picture >> azimuth >> altitude)) {
    throw Error(fmt::format(
        "{}: {}: expected a picture's name, azimuth, altitude and, of one, its receiver", place,
        line));
  }
  std::getline(words >> std::ws, view.receiver);
  if (view.picture.find('/') != std::string::npos) {
    throw Error(fmt::format("{}: {}: expected a file's name without folders", place, view.picture));
  }
  view.sun = naming(place, [&] { return direction_of_degrees(azimuth, altitude); });
  return view;
}

}  // namespace

SunDirection direction_of_degrees(double azimuth_degrees, double altitude_degrees) {
  constexpr double zenith = 90.0;
  constexpr double circle = 360.0;
  if (!(altitude_degrees > 0.0) || altitude_degrees > zenith) {
    throw Error(
        fmt::format("sun altitude {}: expected degrees above 0, up to 90", altitude_degrees));
  }
  if (!(azimuth_degrees >= -circle) || azimuth_degrees > circle) {
    throw Error(fmt::format("sun azimuth {}: expected degrees of -360 to 360", azimuth_degrees));
  }
  return {glm::radians(azimuth_degrees), glm::radians(altitude_degrees)};
}

std::vector<View> read_views(std::filesystem::path const& list) {
  std::ifstream file(list);
  if (!file) throw Error(fmt::format("{}: cannot be read", list.string()));
  std::vector<View> views;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (line.back() == '\r') line.pop_back();
    views.push_back(read_view(line, fmt::format("{}, line {}", list.string(), number)));
  }
  return views;
}

void write_views(std::filesystem::path const& list, std::vector<View> const& views) {
  write_whole_file(list, [&](std::ostream& file) {
    for (auto const& view : views) {
      file << fmt::format("{} {:.9g} {:.9g} {}\n", view.picture, glm::degrees(view.sun.azimuth),
                          glm::degrees(view.sun.altitude), view.receiver);
    }
  });
}

}  // namespace gpu_shading::energyplus
