#include "lean/placeholders.h"

#include <fmt/format.h>

#include <array>

namespace gpu_shading::energyplus {
namespace {

using Corner = std::array<double, 3>;

// Centred on the ground, where EnergyPlus takes a surface's air temperature from.
std::array<Corner, 4> corners(Placeholder const& placeholder) {
  constexpr double far = 1e6;  // metres: no model's coordinates are larger
  double const side = placeholder.north ? 1.0 : -1.0;
  auto const corner = [&](double x, double z) { return Corner{x * far, side * far, z * far}; };
  return {corner(side, 1), corner(side, -1), corner(-side, -1), corner(-side, 1)};
}

}  // namespace

std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken) {
  std::vector<Placeholder> placeholders;
  int number = 0;
  auto const add = [&](std::string const& schedule, bool north) {
    std::string name;
    do {
      name = fmt::format("GPU SHADING PLACEHOLDER {}", ++number);
    } while (taken.contains(name));
    placeholders.push_back({name, schedule, north});
  };
  add("", true);
  add("", false);
  for (auto const& schedule : schedules) add(schedule, true);
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
