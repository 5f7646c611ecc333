#include "model/geometry_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "model/site/farthest_coordinate.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view rules_type = "GlobalGeometryRules";

// Position of a field's value among those that it may have.
template <std::size_t N>
int choice(InputObject const& object, std::string const& field, std::string_view title,
           std::array<std::string_view, N> const& known) {
  auto const& value = object[field];
  auto const found = std::ranges::find_if(
      known, [&](std::string_view candidate) { return same_name(candidate, value); });
  if (found == known.end()) {
    throw Error(fmt::format("{}: {} is \"{}\"", object.type, title, value));
  }
  return static_cast<int>(found - known.begin());
}

double number(InputObject const& object, std::string const& field, std::string_view title) {
  auto const& text = object[field];
  if (text.empty()) return 0.0;
  auto const value = parse_number(text);
  if (!value || std::abs(*value) > farthest_coordinate) {
    throw Error(fmt::format("{}: {} is {}, expected a number from {} to {}", object.title(), title,
                            in_quotes(text), -farthest_coordinate, farthest_coordinate));
  }
  return *value;
}

// Rotates by degrees clockwise, as seen from above.
glm::dvec3 turned(glm::dvec3 const& point, double degrees) {
  double const angle = glm::radians(degrees);
  double const c = std::cos(angle);
  double const s = std::sin(angle);
  return {point.x * c + point.y * s, point.y * c - point.x * s, point.z};
}

constexpr double coincident = 0.01;  // metres; EnergyPlus's own limit

// The vertex that EnergyPlus deletes next: of those within the limit of a neighbour, the one whose
// two adjacent edges are shortest in total.
std::optional<std::size_t> next_deleted(Ring const& ring) {
  std::size_t const count = ring.size();
  std::optional<std::size_t> found;
  double shortest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    double const before = glm::distance(ring[(i + count - 1) % count], ring[i]);
    double const after = glm::distance(ring[i], ring[(i + 1) % count]);
    if (std::min(before, after) < coincident && (!found || before + after < shortest)) {
      found = i;
      shortest = before + after;
    }
  }
  return found;
}

// The first vertex between two edges of nearly the same direction; `straight` is the largest sine.
std::optional<std::size_t> find_straight(Ring const& ring, double straight) {
  std::size_t const count = ring.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto const before = ring[i] - ring[(i + count - 1) % count];
    auto const after = ring[(i + 1) % count] - ring[i];
    double const lengths = glm::length(before) * glm::length(after);
    if (glm::length(glm::cross(before, after)) <= straight * lengths) return i;
  }
  return std::nullopt;
}

// Rounds to single precision where that is fine enough.
glm::dvec3 rounded(glm::dvec3 vertex) {
  for (int axis = 0; axis < 3; ++axis) {
    auto& value = vertex[axis];
    if (std::abs(value) < single_precision_reach) value = static_cast<float>(value);
  }
  return vertex;
}

void note_deletions(Outline& outline) {
  constexpr std::size_t fewest = 3;
  auto kept = outline.vertices;
  while (auto const vertex = next_deleted(kept)) {
    outline.degenerate = kept.size() <= fewest;
    if (outline.degenerate) return;
    outline.simplified = true;
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(*vertex));
  }
}

bool changes_shape(InputObject const& transform) {
  return parse_number(transform["current_aspect_ratio"]) !=
         parse_number(transform["new_aspect_ratio"]);
}

// The first by its name, or "".
std::string find_turned_zone(GeometryRules const& rules) {
  std::string first;
  for (auto const& [name, zone] : rules.zones) {
    if (zone.direction != 0.0 && (first.empty() || name < first)) first = name;
  }
  return first;
}

}  // namespace

GeometryRules read_geometry_rules(std::vector<InputObject> const& objects) {
  GeometryRules rules;
  int found = 0;
  for (auto const& object : objects) {
    if (object.type == rules_type) {
      ++found;
      rules.first_corner =
          choice<4>(object, "starting_vertex_position", "Starting Vertex Position",
                    {"UpperLeftCorner", "LowerLeftCorner", "LowerRightCorner", "UpperRightCorner"});
      rules.clockwise = choice<2>(object, "vertex_entry_direction", "Vertex EntryPatch Direction",
                                  {"Counterclockwise", "Clockwise"}) == 1;
      rules.relative =
          choice<2>(object, "coordinate_system", "Coordinate System", {"World", "Relative"}) == 1;
    } else if (object.type == "Building") {
      rules.north_axis = number(object, "north_axis", "North Axis");
    } else if (object.type == "Zone") {
      rules.zones[upper(object.name)] = {
          number(object, "direction_of_relative_north", "Direction of Relative North"),
          {number(object, "x_origin", "X Origin"), number(object, "y_origin", "Y Origin"),
           number(object, "z_origin", "Z Origin")}};
    }
  }
  if (found != 1) {
    throw Error(fmt::format("{}: given {} times, expected once", rules_type, found));
  }
  return rules;
}

std::optional<Ring> vertices_of(InputObject const& object) {
  auto texts = object.list;
  if (object.type == "FenestrationSurface:Detailed") {
    for (int vertex = 1; vertex <= 4; ++vertex) {
      for (char const axis : {'x', 'y', 'z'}) {
        texts.push_back(object[fmt::format("vertex_{}_{}_coordinate", vertex, axis)]);
      }
    }
    while (!texts.empty() && texts.back().empty()) texts.pop_back();
  }
  auto const count = texts.size() / 3;
  if (count < 3 || texts.size() % 3 != 0) return std::nullopt;
  auto const& given = object["number_of_vertices"];
  if (!given.empty() && !same_name(given, "autocalculate")) {
    auto const number = parse_number(given);
    if (!number || *number != static_cast<double>(count)) return std::nullopt;
  }
  Ring ring;
  ring.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 vertex;
    for (int axis = 0; axis < 3; ++axis) {
      auto const value = parse_number(texts[3 * i + static_cast<std::size_t>(axis)]);
      if (!value) return std::nullopt;
      vertex[axis] = *value;
    }
    ring.push_back(vertex);
  }
  return ring;
}

Ring in_energyplus_order(GeometryRules const& rules, Ring vertices) {
  // The first vertex stays first.
  if (rules.clockwise && !vertices.empty()) std::reverse(vertices.begin() + 1, vertices.end());
  // A triangle has no upper right corner.
  constexpr int upper_right = 3;
  bool const triangle = vertices.size() == 3 && rules.first_corner == upper_right;
  if (!triangle && static_cast<std::size_t>(rules.first_corner) < vertices.size()) {
    std::rotate(vertices.begin(), vertices.end() - rules.first_corner, vertices.end());
  }
  return vertices;
}

Ring without_deleted(Ring ring, double straight) {
  constexpr std::size_t fewest = 3;
  while (ring.size() > fewest) {
    auto vertex = next_deleted(ring);
    if (!vertex) vertex = find_straight(ring, straight);
    if (!vertex) break;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(*vertex));
  }
  return ring;
}

Outline to_world(GeometryRules const& rules, Ring vertices, Attachment attachment,
                 GeometryRules::Zone const& zone) {
  vertices = in_energyplus_order(rules, std::move(vertices));
  if (rules.relative && attachment != Attachment::site) {
    for (auto& vertex : vertices) {
      if (attachment == Attachment::zone) vertex = turned(vertex, zone.direction) + zone.origin;
      vertex = turned(vertex, rules.north_axis);
    }
  }
  Outline outline{std::move(vertices)};
  note_deletions(outline);
  for (auto& vertex : outline.vertices) vertex = rounded(vertex);
  return outline;
}

std::string warn_of_transform(std::vector<InputObject> const& objects) {
  auto const transform = std::ranges::find(objects, "GeometryTransform", &InputObject::type);
  if (transform == objects.end() || !changes_shape(*transform)) return {};
  auto const rules = read_geometry_rules(objects);
  if (!rules.relative) return {};  // EnergyPlus ignores it
  auto const turned = find_turned_zone(rules);
  return fmt::format(
      "{}: EnergyPlus moves vertices but keeps the areas{} of before, so sunlit fractions are "
      "wrong, with polygon clipping too; write the transformed vertices into the model instead",
      transform->where(),
      turned.empty()
          ? ""
          : fmt::format(" and, in turned zones such as {}, the azimuths", printable(turned)));
}

}  // namespace gpu_shading::energyplus
