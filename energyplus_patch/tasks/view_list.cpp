#include "tasks/view_list.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <sstream>
#include <unordered_map>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

SunView read_view(std::string const& line, std::string const& place) {
  std::istringstream words(line);
  double azimuth = 0.0;
  double altitude = 0.0;
  SunView view;
  if (!(words >> view.picture >> azimuth >> altitude)) {
    throw Error(
        fmt::format("{}: {}: expected the name of a picture, azimuth, altitude and, for a single "
                    "receiver, its name",
                    place, in_quotes(line)));
  }
  std::getline(words >> std::ws, view.receiver);
  if (view.picture.find('/') != std::string::npos) {
    throw Error(fmt::format("{}: {}: expected the name of a file without folders", place,
                            in_quotes(view.picture)));
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
    throw Error(fmt::format("sun azimuth {}: expected degrees from -360 to 360", azimuth_degrees));
  }
  return {glm::radians(azimuth_degrees), glm::radians(altitude_degrees)};
}

std::vector<SunView> read_views(std::filesystem::path const& list) {
  std::istringstream file(read_text_file(list));
  std::vector<SunView> views;
  std::unordered_map<std::string, int> lines;  // by picture
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (line.back() == '\r') line.pop_back();
    auto const place = fmt::format("{}, line {}", list.string(), number);
    views.push_back(read_view(line, place));
    auto const& picture = views.back().picture;
    if (auto const [found, is_new] = lines.try_emplace(picture, number); !is_new) {
      throw Error(fmt::format("{}: {}: expected a name of its own; line {} has the same", place,
                              in_quotes(picture), found->second));
    }
  }
  return views;
}

}  // namespace gpu_shading::energyplus
