#include "runs/drawing.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// The plane of a wall, which contains its openings.
struct Plane {
  glm::dvec3 point;
  glm::dvec3 normal;

  explicit Plane(Ring const& wall) : point(0.0), normal(gpu_shading::normal({wall, {}})) {
    for (auto const& vertex : wall) point += vertex / static_cast<double>(wall.size());
  }

  glm::dvec3 nearest(glm::dvec3 const& p) const { return p - glm::dot(p - point, normal) * normal; }
};

Ring onto(Plane const& plane, Ring const& ring) {
  Ring flat;
  flat.reserve(ring.size());
  for (auto const& vertex : ring) flat.push_back(plane.nearest(vertex));
  return flat;
}

// The reveals between a set-back window and the opening in its wall's plane, as seen from within
// the opening.
std::vector<Surface> reveals_of(DrawnSurface const& window, Ring const& opening) {
  constexpr double min_depth = 1e-3;
  std::vector<Surface> reveals;
  if (glm::distance(window.outline.front(), opening.front()) < min_depth) return reveals;
  for (std::size_t i = 0; i < opening.size(); ++i) {
    auto const next = (i + 1) % opening.size();
    Surface reveal;
    reveal.name = fmt::format("{} reveal {}", window.name, i + 1);
    reveal.polygon.outline = {opening[i], window.outline[i], window.outline[next], opening[next]};
    reveals.push_back(std::move(reveal));
  }
  return reveals;
}

}  // namespace

std::vector<Surface> surfaces_of(std::vector<DrawnSurface> const& drawing,
                                 ShadingInput const& input) {
  std::vector<Surface> surfaces;
  std::unordered_map<std::string, std::size_t> place_of;
  for (auto const& drawn : drawing) {
    place_of[upper(drawn.name)] = surfaces.size();
    Surface surface;
    surface.name = drawn.name;
    surface.polygon.outline = drawn.outline;
    surfaces.push_back(std::move(surface));
  }
  for (auto const& drawn : drawing) {
    auto const base = input.base_of.find(upper(drawn.name));
    if (base == input.base_of.end() || drawn.outline.empty()) continue;
    auto const wall = place_of.find(base->second);
    if (wall == place_of.end()) continue;
    auto& polygon = surfaces[wall->second].polygon;
    auto opening = onto(Plane(polygon.outline), drawn.outline);
    auto reveals = reveals_of(drawn, opening);
    polygon.holes.push_back(std::move(opening));
    for (auto& reveal : reveals) surfaces.push_back(std::move(reveal));
  }
  return surfaces;
}

bool is_exterior(std::string const& surface, ShadingInput const& input) {
  auto const wall = input.base_surface(upper(surface));
  return input.zone_of.contains(wall) && !input.not_exterior.contains(wall);
}

namespace {

// Comments before a polyline: "Building Shading:NAME", "Fixed Shading:NAME" or "ZONE:NAME"; the
// zones are listed earlier, as "Zone=1:ZONE".
class Names {
 public:
  void read_zone(std::string const& comment) {
    constexpr std::string_view start = "Zone=";
    auto const colon = comment.find(':');
    if (comment.starts_with(start) && colon != std::string::npos) {
      owners_.push_back(comment.substr(colon + 1) + ":");
    }
  }

  std::string name_of(std::string const& comment) const {
    std::size_t longest = 0;  // a zone's name may be the beginning of another's
    for (auto const& owner : owners_) {
      if (comment.starts_with(owner)) longest = std::max(longest, owner.size());
    }
    if (longest == 0) longest = comment.find(':') + 1;
    return comment.substr(longest);
  }

 private:
  std::vector<std::string> owners_{"Building Shading:", "Fixed Shading:"};
};

double coordinate(std::string const& text) {
  auto const value = parse_number(trimmed(text));
  if (!value) throw Error("eplusout.dxf: \"" + trimmed(text) + "\" is not a number");
  return *value;
}

}  // namespace

std::vector<DrawnSurface> read_drawing(std::istream& dxf) {
  std::vector<DrawnSurface> surfaces;
  Names names;
  std::string comment;
  std::optional<DrawnSurface> current;
  bool in_vertex = false;
  bool ended = false;
  std::string code;
  std::string value;
  while (std::getline(dxf, code) && std::getline(dxf, value)) {
    code = trimmed(code);
    if (code == "999") {
      comment = trimmed(value);
      names.read_zone(comment);
    } else if (code == "0") {
      auto const entity = trimmed(value);
      in_vertex = entity == "VERTEX" && current;
      if (in_vertex) current->outline.emplace_back(0.0);
      if (entity == "POLYLINE") current = DrawnSurface{names.name_of(comment), {}};
      if (entity == "SEQEND" && current) {
        if (!current->name.starts_with("Mir-")) surfaces.push_back(std::move(*current));
        current.reset();
      }
      ended = ended || entity == "EOF";
    } else if (in_vertex && (code == "10" || code == "20" || code == "30")) {
      current->outline.back()[code[0] - '1'] = coordinate(value);
    }
  }
  if (!ended) throw Error("eplusout.dxf: ends unexpectedly");
  return surfaces;
}

}  // namespace gpu_shading::energyplus
