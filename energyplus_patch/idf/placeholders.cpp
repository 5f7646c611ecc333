#include "idf/placeholders.h"

#include <fmt/format.h>

#include <array>

namespace gpu_shading::energyplus {
namespace {

using Corner = std::array<double, 3>;

// Centred on the ground, which determines the air temperature that EnergyPlus uses for a surface.
// It faces the model.
std::array<Corner, 4> corners(Placeholder const& placeholder) {
  constexpr double far = 1e6;  // metres; larger than any model's coordinates
  constexpr double width = 0.1;
  double const east = placeholder.quarter == 0 || placeholder.quarter == 3 ? 1.0 : -1.0;
  double const north = placeholder.quarter < 2 ? 1.0 : -1.0;
  auto const corner = [&](double side, double z) {
    return Corner{east * far + side * north * width, north * far - side * east * width, z * far};
  };
  return {corner(-1, 1), corner(-1, -1), corner(1, -1), corner(1, 1)};
}

}  // namespace

std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken) {
  std::vector<Placeholder> placeholders;
  int number = 0;
  auto const add = [&](std::string const& schedule, int quarter) {
    std::string name;
    do {
      name = fmt::format("GPU SHADING PLACEHOLDER {}", ++number);
    } while (taken.contains(name));
    placeholders.push_back({name, schedule, quarter});
  };
  for (int quarter = 0; quarter < 4; ++quarter) add("", quarter);
  for (auto const& schedule : schedules) add(schedule, 0);
  return placeholders;
}

std::vector<std::string> placeholder_fields(Placeholder const& placeholder) {
  std::vector<std::string> fields{placeholder.name, placeholder.schedule, "4"};
  for (auto const& corner : corners(placeholder)) {
    for (double const value : corner) fields.push_back(fmt::format("{}", value));
  }
  return fields;
}

nlohmann::json placeholder_json(Placeholder const& placeholder) {
  nlohmann::json object;
  if (!placeholder.schedule.empty()) object["transmittance_schedule_name"] = placeholder.schedule;
  object["number_of_vertices"] = 4;
  for (auto const& [x, y, z] : corners(placeholder)) {
    object["vertices"].push_back(
        {{"vertex_x_coordinate", x}, {"vertex_y_coordinate", y}, {"vertex_z_coordinate", z}});
  }
  return object;
}

}  // namespace gpu_shading::energyplus
