#include "scene/shade_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using Axis = MovingShade::Axis;
using Motion = MovingShade::Motion;

// Below this, components of a unit vector are taken as 0, and lengths as equal.
constexpr double rounding = 1e-3;
constexpr double half_circle = 180.0;

struct Edge {
  glm::dvec3 from;
  glm::dvec3 to;

  glm::dvec3 along() const { return to - from; }
  double length() const { return glm::length(along()); }
};

// `Better`: whether the first of two edges is to be taken.
template <typename Better>
Edge choose_edge(Ring const& ring, Better const& better) {
  Edge best{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Edge const edge{ring[i], ring[(i + 1) % ring.size()]};
    if (edge.length() > 0.0 && (best.length() <= 0.0 || better(edge, best))) best = edge;
  }
  return best;
}

double slope(Edge const& edge) { return std::abs(edge.along().z) / edge.length(); }

bool is_longer(Edge const& edge, Edge const& other) {
  double const difference = edge.length() / other.length() - 1.0;
  return difference > rounding || (difference > -rounding && slope(edge) < slope(other) - rounding);
}

// East, or north, or up.
glm::dvec3 oriented(glm::dvec3 const& direction) {
  for (auto const component : {direction.x, direction.y, direction.z}) {
    if (std::abs(component) > rounding) return component > 0.0 ? direction : -direction;
  }
  return direction;
}

// Of the area. Triangles from the first vertex count with their sign.
glm::dvec3 centroid(Ring const& ring) {
  auto const up = normal({ring, {}});
  glm::dvec3 sum{0.0};
  double weights = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    double const weight = glm::dot(glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]), up);
    sum += weight * (ring[i] + ring[i + 1] - 2.0 * ring[0]) / 3.0;
    weights += weight;
  }
  return weights > 0.0 ? ring[0] + sum / weights : ring[0];
}

glm::dvec3 turned(glm::dvec3 const& point, RotationAxis const& axis, double angle) {
  auto const arm = point - axis.point;
  auto const along = glm::dot(arm, axis.direction) * axis.direction;
  auto const across = arm - along;
  return axis.point + along + std::cos(angle) * across +
         std::sin(angle) * glm::cross(axis.direction, across);
}

// The first and last coordinate along a direction.
std::pair<double, double> reach(Polygon const& polygon, glm::dvec3 const& direction) {
  auto const [low, high] = std::minmax_element(
      polygon.outline.begin(), polygon.outline.end(), [&](auto const& a, auto const& b) {
        return glm::dot(a, direction) < glm::dot(b, direction);
      });
  return {glm::dot(*low, direction), glm::dot(*high, direction)};
}

// Every second panel turns the other way, from the hinge that the one before it has moved out.
PointMotion folding(Polygon const& drawn, MovingShade const& shade, double position) {
  auto const& starts = shade.track.starts;
  double const start = reach(drawn, shade.direction).first;
  auto const place = std::min_element(starts.begin(), starts.end(), [&](double a, double b) {
    return std::abs(a - start) < std::abs(b - start);
  });
  bool const second = (place - starts.begin()) % 2 == 1;
  double const angle = glm::radians(position);
  auto const& first = drawn.outline.front();
  RotationAxis const axis{first + (*place - glm::dot(first, shade.direction)) * shade.direction,
                          glm::cross(shade.direction, shade.track.outward)};
  auto shift = (starts.front() - *place) * (1.0 - std::cos(angle)) * shade.direction;
  if (second) shift += (*place - *std::prev(place)) * std::sin(angle) * shade.track.outward;
  return [=](auto const& point) { return shift + turned(point, axis, second ? -angle : angle); };
}

glm::dvec3 stay(glm::dvec3 const& point) { return point; }

}  // namespace

void expect_parallel(std::vector<Surface> const& drawn, MovingShade const& shade) {
  auto const& first = drawn.front();
  auto const axis = rotation_axis(first.polygon, shade).direction;
  for (auto const& surface : drawn) {
    auto const other = rotation_axis(surface.polygon, shade).direction;
    double const between_axes =
        glm::degrees(std::atan2(glm::length(glm::cross(axis, other)), glm::dot(axis, other)));
    // Either side may face the sun.
    double const turn = facing_position(first.polygon, shade, normal(surface.polygon));
    double const off = std::max(between_axes, std::abs(std::remainder(turn, half_circle)));
    if (off <= std::max(shade.step, 1.0)) continue;
    throw Error(fmt::format(
        "{}: {} is at {:.3g} degrees to {}; TrackSun expects parallel surfaces: write an object "
        "for each orientation",
        shade.where, printable(surface.name), off, printable(first.name)));
  }
}

MovingShade::Track fold_track(std::vector<Polygon> const& drawn, MovingShade const& shade) {
  MovingShade::Track track;
  std::vector<std::pair<double, double>> reaches;
  for (auto const& panel : drawn) {
    if (area(panel) <= 0.0) continue;
    reaches.push_back(reach(panel, shade.direction));
    bool const first = reaches.back() <= *std::min_element(reaches.begin(), reaches.end());
    if (first) track.outward = normal(panel);
    if (std::abs(glm::dot(normal(panel), shade.direction)) > rounding) {
      throw Error(fmt::format("{}: Direction is at an angle to panels, expected one along them",
                              shade.where));
    }
  }
  std::sort(reaches.begin(), reaches.end());
  // Panels above each other fold together.
  auto const same = [](auto const& a, auto const& b) { return b.first - a.first < rounding; };
  reaches.erase(std::unique(reaches.begin(), reaches.end(), same), reaches.end());
  if (reaches.empty() || reaches.size() % 2 != 0) {
    throw Error(fmt::format("{}: {} panels along Direction, expected pairs for Fold", shade.where,
                            reaches.size()));
  }
  for (std::size_t i = 0; i < reaches.size(); i += 2) {
    double const one = reaches[i + 1].first - reaches[i].first;
    double const other = reaches[i + 1].second - reaches[i + 1].first;
    constexpr double most = 0.1;
    if (std::abs(one - other) > most * one) {
      throw Error(
          fmt::format("{}: panels {} and {} along Direction are {:.6g} and {:.6g} m wide, "
                      "expected pairs of equal width for Fold",
                      shade.where, i + 1, i + 2, one, other));
    }
  }
  for (auto const& [start, end] : reaches) track.starts.push_back(start);
  return track;
}

RotationAxis rotation_axis(Polygon const& drawn, MovingShade const& shade) {
  auto const& ring = drawn.outline;
  if (shade.axis == Axis::given || ring.empty()) return {shade.point, shade.direction};
  if (shade.axis == Axis::centre_line) {
    auto const edge = choose_edge(ring, is_longer);
    return {centroid(ring), oriented(glm::normalize(edge.along()))};
  }
  auto const edge = choose_edge(ring, [&](Edge const& one, Edge const& other) {
    return glm::dot(one.from + one.to - other.from - other.to, shade.direction) > 0.0;
  });
  return {edge.from, oriented(glm::normalize(edge.along()))};
}

PointMotion motion_of(Polygon const& drawn, MovingShade const& shade, double position) {
  // Degenerate ones cast no shadow.
  if (area(drawn) <= 0.0) return stay;
  switch (shade.motion) {
    case Motion::rotate: {
      if (position == 0.0) return stay;
      auto const axis = rotation_axis(drawn, shade);
      double const angle = glm::radians(position);
      return [=](auto const& point) { return turned(point, axis, angle); };
    }
    case Motion::slide: {
      auto const shift = position * shade.direction;
      return [=](auto const& point) { return point + shift; };
    }
    case Motion::fold:
      if (position == 0.0) return stay;
      return folding(drawn, shade, position);
    case Motion::extend:
      break;
  }
  if (position == 1.0) return stay;
  double const fixed = reach(drawn, shade.direction).first;
  return [fixed, position, direction = shade.direction](auto const& point) {
    double const length = glm::dot(point, direction) - fixed;
    return point + (position - 1.0) * length * direction;
  };
}

Polygon moved(Polygon const& drawn, MovingShade const& shade, double position) {
  auto const move = motion_of(drawn, shade, position);
  auto polygon = drawn;
  std::ranges::transform(polygon.outline, polygon.outline.begin(), move);
  for (auto& hole : polygon.holes) std::ranges::transform(hole, hole.begin(), move);
  return polygon;
}

TextureAxes moved(TextureAxes const& drawn, MovingShade const& shade, double position) {
  auto const& [origin, u, v] = drawn;
  auto const corners =
      moved(Polygon{{origin, origin + u, origin + v}, {}}, shade, position).outline;
  return {corners[0], corners[1] - corners[0], corners[2] - corners[0]};
}

double facing_position(Polygon const& drawn, MovingShade const& shade,
                       glm::dvec3 const& towards_sun) {
  auto const axis = rotation_axis(drawn, shade).direction;
  auto const from = normal(drawn);
  double const sine = glm::dot(glm::cross(from, towards_sun), axis);
  double const cosine =
      glm::dot(from, towards_sun) - glm::dot(from, axis) * glm::dot(towards_sun, axis);
  return std::hypot(sine, cosine) > 0.0 ? glm::degrees(std::atan2(sine, cosine)) : 0.0;
}

}  // namespace gpu_shading::energyplus
