#include "model/input/moving_shades.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "gpu_shading/error.h"
#include "model/idf/fields.h"
#include "platform/named_entries.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::moving_shade;
using Motion = MovingShade::Motion;
using Axis = MovingShade::Axis;
using Control = MovingShade::Control;

constexpr double max_steps = 10'000.0;
// Of a step, so that decimal fractions are on the grid.
constexpr double rounding = 1e-6;

using ByName = std::map<std::string, std::string>;

void read_surfaces(InputObject const& object, ShadingInput const& input, ByName const& surroundings,
                   ByName& taken, MovingShade& shade) {
  auto const pattern = read(object, field::surface_name);
  auto const refuse = [&](std::string const& why) {
    throw Error(fmt::format("{} is {}: {}", field::surface_name.title, in_quotes(pattern), why));
  };
  for_each_match(input.shading_surfaces, pattern, [&](auto const& entry) {
    auto const& surface = entry.first;
    if (auto const outside = surroundings.find(surface); outside != surroundings.end()) {
      if (outside->second != extension::geometry::type) {
        refuse(fmt::format("{} is part of a {}, which cannot move", surface, outside->second));
      }
      // The faces of a mesh have no axes and edges of their own.
      bool const together =
          shade.motion == Motion::slide || (shade.turns() && shade.axis == Axis::given);
      if (!together) {
        refuse(
            fmt::format("{} is a mesh, expected Motion Slide, or Rotate with Axis Given", surface));
      }
    }
    auto const [place, added] = taken.try_emplace(surface, object.name);
    if (!added) refuse(fmt::format("{} is named by {} already", surface, place->second));
    shade.surfaces.push_back(surface);
  });
  if (shade.surfaces.empty()) refuse("no shading surface of the model matches");
}

void read_motion(InputObject const& object, MovingShade& shade) {
  shade.motion = read(object, field::motion);
  shade.axis = read(object, field::axis);
  bool const given = shade.turns() && shade.axis == Axis::given;
  glm::dvec3 const direction{read(object, field::direction_x), read(object, field::direction_y),
                             read(object, field::direction_z)};
  double const length = glm::length(direction);
  bool const needed = !shade.turns() || shade.axis != Axis::centre_line;
  if (needed && length <= 0.0) {
    throw Error(fmt::format("{}, Y and Z are 0, expected a vector", field::direction_x.title));
  }
  if (!needed && length > 0.0) {
    throw Error(
        fmt::format("{}, Y and Z: expected blanks with Axis CentreLine", field::direction_x.title));
  }
  if (!shade.turns()) expect_blank(object, {field::axis}, "unless Motion is Rotate");
  if (!given) {
    expect_blank(object, {field::point_x, field::point_y, field::point_z}, "unless Axis is Given");
  }
  if (needed) shade.direction = direction / length;
  shade.point = {read(object, field::point_x), read(object, field::point_y),
                 read(object, field::point_z)};
}

void read_range(InputObject const& object, MovingShade& shade) {
  constexpr double quarter = 90.0;
  bool const degrees = shade.turns() || shade.folds();
  shade.minimum = read(object, field::minimum_position);
  shade.maximum = read(object, field::maximum_position).value_or(degrees ? quarter : 1.0);
  double const range = shade.maximum - shade.minimum;
  if (range <= 0.0) {
    throw Error(fmt::format("{} is {}, expected more than {} {}", field::maximum_position.title,
                            shade.maximum, field::minimum_position.title, shade.minimum));
  }
  if (shade.motion == Motion::extend && (shade.minimum < 0.0 || shade.maximum > 1.0)) {
    throw Error(fmt::format("{} {} and {} {}: expected shares from 0 to 1 for Extend",
                            field::minimum_position.title, shade.minimum,
                            field::maximum_position.title, shade.maximum));
  }
  if (shade.folds() && (shade.minimum < -quarter || shade.maximum > quarter)) {
    throw Error(fmt::format("{} {} and {} {}: expected -90 to 90 degrees for Fold",
                            field::minimum_position.title, shade.minimum,
                            field::maximum_position.title, shade.maximum));
  }
  shade.step = read(object, field::step).value_or(degrees ? 1.0 : range / 100.0);
  if (range > max_steps * shade.step) {
    throw Error(fmt::format("{} is {}, expected at least {} for at most {} positions",
                            field::step.title, shade.step, range / max_steps, max_steps));
  }
  shade.rest = read(object, field::position_at_rest).value_or(shade.minimum);
  if (shade.rest < shade.minimum || shade.rest > shade.maximum) {
    throw Error(fmt::format("{} is {}, expected {} to {}", field::position_at_rest.title,
                            shade.rest, shade.minimum, shade.maximum));
  }
  shade.rest = shade.nearest(shade.rest);
}

void read_control(InputObject const& object, MovingShade& shade) {
  shade.control = read(object, field::control);
  shade.schedule = upper(read(object, field::position_schedule_name));
  shade.receivers = read(object, field::receiver_name);
  shade.availability = upper(read(object, field::availability_schedule_name));
  shade.minimum_beam = read(object, field::minimum_beam);
  shade.hysteresis = read(object, field::hysteresis);
  shade.tolerance = read(object, field::tolerance);
  shade.maximum_wind = read(object, field::maximum_wind_speed);
  if (shade.control == Control::schedule) {
    if (shade.schedule.empty()) refuse_blank(field::position_schedule_name);
    expect_blank(object,
                 {field::receiver_name, field::availability_schedule_name, field::minimum_beam,
                  field::hysteresis},
                 "with Control Schedule");
    return;
  }
  expect_blank(object, {field::position_schedule_name}, "unless Control is Schedule");
  if (shade.receivers.empty() && (shade.control == Control::block_beam || shade.minimum_beam)) {
    refuse_blank(field::receiver_name);
  }
  if (shade.control != Control::block_beam) {
    expect_blank(object, {field::tolerance}, "unless Control is BlockBeam");
  }
  if (shade.control == Control::track_sun && !shade.turns()) {
    throw Error(
        fmt::format("{} is TrackSun, expected Motion Rotate with it", field::control.title));
  }
}

}  // namespace

double MovingShade::nearest(double position) const {
  double const steps = std::floor((maximum - minimum) / step + rounding);
  double const within = std::clamp(position, minimum, maximum);
  double const on_grid = minimum + step * std::min(std::round((within - minimum) / step), steps);
  bool const last = maximum - within < std::abs(within - on_grid);
  return last ? maximum : std::min(on_grid, maximum);
}

double MovingShade::neighbour(double position, bool above) const {
  double const steps = (position - minimum) / step;
  double const to = above ? std::floor(steps + rounding) + 1.0 : std::ceil(steps - rounding) - 1.0;
  return nearest(minimum + step * to);
}

std::vector<double> MovingShade::positions() const {
  std::vector<double> all;
  auto const steps = static_cast<int>(std::floor((maximum - minimum) / step + rounding));
  for (int i = 0; i <= steps; ++i) all.push_back(std::min(minimum + i * step, maximum));
  if (maximum - all.back() > rounding * step) all.push_back(maximum);
  return all;
}

std::string_view MovingShade::unit() const {
  if (turns() || folds()) return "deg";
  return motion == Motion::slide ? "m" : "share";
}

std::string MovingShade::describe() const {
  auto const word = [](auto const& info, auto value) {
    return info.words[static_cast<std::size_t>(value)];
  };
  auto const by = control == Control::schedule ? " " + schedule : std::string();
  return fmt::format(
      "{}: {} surface{}, {} from {} to {} {} in steps of {:.6g}, at rest at {}, by {}{}", where,
      surfaces.size(), surfaces.size() == 1 ? "" : "s", word(field::motion, motion), minimum,
      maximum, unit(), step, rest, word(field::control, control), by);
}

std::vector<MovingShade> read_moving_shades(std::vector<InputObject> const& objects,
                                            ShadingInput const& input, ByName const& surroundings) {
  std::vector<MovingShade> shades;
  ByName taken;
  for_each_of(objects, field::type, [&](InputObject const& object) {
    MovingShade shade;
    shade.name = object.name;
    shade.where = object.where();
    read_motion(object, shade);
    read_surfaces(object, input, surroundings, taken, shade);
    read_range(object, shade);
    read_control(object, shade);
    shades.push_back(std::move(shade));
  });
  return shades;
}

void set_rest(std::vector<MovingShade>& shades, std::string const& option,
              std::string const& positions) {
  std::vector<std::string> names;
  names.reserve(shades.size());
  for (auto const& shade : shades) names.push_back(shade.name);
  std::istringstream parts(positions);
  for (std::string part; std::getline(parts, part, ',');) {
    auto const equals = part.rfind('=');
    auto const position = parse_number(equals == std::string::npos ? "" : part.substr(equals + 1));
    if (!position) {
      throw Error(fmt::format("{} {}: expected NAME=POSITION", option, in_quotes(part)));
    }
    auto const name = part.substr(0, equals);
    auto const shade =
        std::ranges::find_if(shades, [&](auto const& each) { return same_name(each.name, name); });
    if (shade == shades.end()) {
      throw Error(fmt::format("{} {}: the model has no such {}{}", option, in_quotes(name),
                              field::type, did_you_mean(name, names)));
    }
    if (*position < shade->minimum || *position > shade->maximum) {
      throw Error(fmt::format("{} {}: expected {} to {} {}", option, in_quotes(part),
                              shade->minimum, shade->maximum, shade->unit()));
    }
    shade->rest = shade->nearest(*position);
    shade->stands = true;
  }
}

}  // namespace gpu_shading::energyplus
