#include "model/far_outlines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "model/geometry_rules.h"
#include "model/shading_outlines.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

double largest_of(Ring const& ring) {
  double largest = 0.0;
  for (auto const& point : ring) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(point[axis]));
  }
  return largest;
}

// Whether one point is the other in single precision. Transformed points may be rounded to the
// next number.
bool is_rounded(glm::dvec3 const& passed, glm::dvec3 const& exact) {
  for (int axis = 0; axis < 3; ++axis) {
    double const near = std::max(std::abs(exact[axis]), 1.0);
    if (std::abs(passed[axis] - exact[axis]) > near * std::numeric_limits<float>::epsilon() * 2.0) {
      return false;
    }
  }
  return true;
}

// The exact ring from the vertex with which the passed one begins, or nothing.
std::optional<Ring> aligned(Ring const& passed, Ring exact) {
  if (passed.size() != exact.size()) return std::nullopt;
  for (std::size_t turns = 0; turns < exact.size(); ++turns) {
    if (std::equal(passed.begin(), passed.end(), exact.begin(), is_rounded)) return exact;
    std::rotate(exact.begin(), exact.begin() + 1, exact.end());
  }
  return std::nullopt;
}

bool replace(Ring& passed, Ring const& exact) {
  auto found = aligned(passed, exact);
  // EnergyPlus may have deleted vertices.
  for (double const straight : straight_limits) {
    if (!found) found = aligned(passed, without_deleted(exact, straight));
  }
  if (found) passed = std::move(*found);
  return found.has_value();
}

}  // namespace

FarOutlines::FarOutlines(std::vector<InputObject> const& objects, ShadingInput const& input,
                         Names const& left_out) {
  GeometryRules rules;
  try {
    rules = read_geometry_rules(objects);
  } catch (Error const&) {
    return;  // EnergyPlus reports it
  }
  if (rules.relative) {
    for (auto const& [name, zone] : rules.zones) {
      largest_ = std::max(largest_, glm::length(zone.origin));
    }
  }
  bool const reproduced = reason_against_outlines(objects).empty();
  for (auto const& object : objects) {
    if (!is_detailed_surface(object)) continue;
    auto name = upper(object.name);
    if (left_out.contains(name)) continue;
    auto outline = outline_of(object, input, rules);
    if (!outline) continue;
    double const largest = largest_of(outline->vertices);
    largest_ = std::max(largest_, largest);
    if (largest < single_precision_reach || !reproduced) continue;
    auto const base = input.base_of.find(name);
    if (base != input.base_of.end()) windows_[base->second].push_back(name);
    outlines_.insert_or_assign(std::move(name), std::move(outline->vertices));
  }
}

bool FarOutlines::restore(Surface& surface) const {
  auto const outline = outlines_.find(surface.name);
  if (outline == outlines_.end()) return false;
  bool all = replace(surface.polygon.outline, outline->second);
  std::vector<std::string> windows;
  auto const found = windows_.find(surface.name);
  if (found != windows_.end()) windows = found->second;
  for (auto& hole : surface.polygon.holes) {
    auto const window = std::ranges::find_if(
        windows, [&](std::string const& name) { return replace(hole, outlines_.at(name)); });
    if (window == windows.end()) {
      all = false;
    } else {
      windows.erase(window);  // two may round to the same vertices
    }
  }
  return all;
}

double largest_coordinate(Polygon const& polygon) {
  double largest = largest_of(polygon.outline);
  for (auto const& hole : polygon.holes) largest = std::max(largest, largest_of(hole));
  return largest;
}

double single_precision_error(double coordinate) {
  auto const value = static_cast<float>(coordinate);
  return 0.5 * (std::nextafter(value, std::numeric_limits<float>::infinity()) - value);
}

}  // namespace gpu_shading::energyplus
