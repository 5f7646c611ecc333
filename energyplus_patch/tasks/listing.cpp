#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "gpu_shading/screen_placement.h"
#include "model/extensions/extension_fields.h"
#include "platform/text.h"
#include "reports/remarks.h"
#include "scene/model_rule.h"
#include "scene/shade_motion.h"
#include "scene/shade_optics.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;

// How a surface takes part in the shading calculation.
struct ListedSurface {
  std::string name;
  std::string kind;
  double area = 0.0;                                // m2
  bool receives = false;                            // whether its own sunlit fraction is rendered
  std::optional<std::string> casts = std::nullopt;  // its optics; empty: it casts no shadows
  std::optional<TileAxes> tile = std::nullopt;      // of its screen
  MovingShade const* moves = nullptr;               // that it is part of
  std::vector<Ring> moved = {};                     // its outline at three_positions()
};

// Both ends of a shade's range, and the position at rest between them.
std::array<double, 3> three_positions(MovingShade const& shade) {
  return {shade.minimum, shade.rest, shade.maximum};
}

struct Listing {
  std::vector<std::string> remarks;  // warnings, then remarks
  std::vector<ListedSurface> surfaces;
  std::string rule;  // lines that say which zones do not shade which
};

std::string kind_of(std::string const& name, ShadingInput const& input) {
  if (window_of_reveal(name)) return "reveal";
  if (auto const found = input.shading_surfaces.find(name); found != input.shading_surfaces.end()) {
    return found->second.type;
  }
  return input.base_of.contains(name) ? "window or door" : "heat transfer surface";
}

std::string place(glm::dvec3 const& point, int digits) {
  double const scale = std::pow(10.0, digits);
  // No -0.
  auto const rounded = [&](double value) { return std::round(value * scale) / scale + 0.0; };
  return fmt::format("({0:.{3}f}, {1:.{3}f}, {2:.{3}f})", rounded(point.x), rounded(point.y),
                     rounded(point.z), digits);
}

// The position of a screen's texture or pattern, for users who have to align it.
std::optional<TileAxes> tile_of(Model const& model, Surface const& surface) {
  auto const screen = model.screens.by_surface.find(surface.name);
  if (screen == model.screens.by_surface.end()) return std::nullopt;
  return tile_axes(surface.polygon, screen->second.maker->placement(surface.polygon));
}

// All surfaces except surroundings and mirrored copies that nothing names.
std::vector<SurfaceId> listed(Scene const& scene, Model const& model) {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& name = scene[id].name;
    bool const copy = is_mirrored(name) && !model.shading.names(name);
    if (!copy && !model.surroundings.types.contains(name)) ids.push_back(id);
  }
  return ids;
}

// All triangles with one name.
struct MeshRow {
  SurfaceId first;
  double area = 0.0;
};

std::vector<MeshRow> meshes_of(Scene const& scene, Model const& model) {
  std::vector<MeshRow> rows;
  std::unordered_map<std::string_view, std::size_t> known;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& surface = scene[id];
    auto const type = model.surroundings.types.find(surface.name);
    if (type == model.surroundings.types.end() || type->second == extension::site_context::type) {
      continue;
    }
    auto const size = area(surface.polygon);
    if (size <= 0.0) continue;
    auto const [row, added] = known.try_emplace(surface.name, rows.size());
    if (added) rows.push_back({id});
    rows[row->second].area += size;
  }
  return rows;
}

ListedSurface row_of(SceneAssembly const& scene, SurfaceId id) {
  auto const& model = scene.model();
  auto const& wanted = scene.receives();
  auto const& surface = scene.surfaces()[id];
  ListedSurface row{surface.name, kind_of(surface.name, model.shading), area(surface.polygon)};
  if (row.area <= 0.0) return row;
  row.receives = row.kind != "reveal" && id < wanted.size() && wanted[id];
  if (surface.casting != Casting::never) row.casts = describe_optics(model, surface);
  row.tile = tile_of(model, surface);
  if (auto const shade = scene.moving_shade_of(id)) {
    row.moves = &model.moving_shades[*shade];
    for (double const position : three_positions(*row.moves)) {
      row.moved.push_back(moved(surface.polygon, *row.moves, position).outline);
    }
  }
  return row;
}

std::string table_of(std::vector<ListedSurface> const& rows) {
  std::size_t width = 0;
  std::size_t kind_width = 0;
  for (auto const& row : rows) {
    width = std::max(width, row.name.size());
    kind_width = std::max(kind_width, row.kind.size());
  }
  auto text = fmt::format("{:{}}  {:{}}  {:>12}  {:8}  {}\n", "surface", width, "kind", kind_width,
                          "area [m2]", "receives", "casts");
  for (auto const& row : rows) {
    auto const* const none = row.area <= 0.0 ? "not (no area)" : "not";
    text += fmt::format("{:{}}  {:{}}  {:12.3f}  {:8}  {}\n", row.name, width, row.kind, kind_width,
                        row.area, row.receives ? "yes" : "no", row.casts.value_or(none));
    if (row.moves != nullptr) {
      text += fmt::format("    moves from {} to {} {} with {}\n", row.moves->minimum,
                          row.moves->maximum, row.moves->unit(), row.moves->name);
    }
    if (!row.tile) continue;
    text += fmt::format("    tile from {} m, u along {}, v along {}\n", place(row.tile->origin, 3),
                        place(row.tile->u, 4), place(row.tile->v, 4));
  }
  return text;
}

Json to_json(glm::dvec3 const& vector) { return {vector.x, vector.y, vector.z}; }

Json to_json(ListedSurface const& row) {
  Json json{{"name", row.name}, {"kind", row.kind}, {"area", row.area}, {"receives", row.receives}};
  json["casts"] = row.casts ? Json(*row.casts) : Json();
  if (row.tile) {
    json["tile"] = {{"origin", to_json(row.tile->origin)},
                    {"u", to_json(row.tile->u)},
                    {"v", to_json(row.tile->v)}};
  }
  if (row.moves != nullptr) {
    auto outlines = Json::array();
    for (auto const& ring : row.moved) {
      outlines.push_back(Json::array());
      for (auto const& point : ring) outlines.back().push_back(to_json(point));
    }
    json["moves"] = {{"shade", row.moves->name},
                     {"unit", row.moves->unit()},
                     {"positions", three_positions(*row.moves)},
                     {"outlines", std::move(outlines)}};
  }
  return json;
}

std::vector<std::string> lines_of(SceneAssembly const& scene) {
  auto lines = scene.model().early_warnings;
  for (auto const& more : {warnings_of(scene), remarks_of(scene.model())}) {
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

// EnergyPlus's surfaces, and after these those that are not in its input: first those left out by
// lean input, then the surroundings, with one row for a mesh and none for neighbouring buildings
// and terrain.
Listing list_surfaces(SceneAssembly const& assembly) {
  auto const& scene = assembly.surfaces();
  auto const& model = assembly.model();
  Listing listing{lines_of(assembly), {}, describe(make_shading_rule(model.shading, scene, {}))};
  for (auto const id : listed(scene, model)) listing.surfaces.push_back(row_of(assembly, id));
  for (auto const& mesh : meshes_of(scene, model)) {
    auto const& surface = scene[mesh.first];
    listing.surfaces.push_back(
        {surface.name, model.surroundings.types.at(surface.name), mesh.area, false,
         describe_optics(model, surface, model.surroundings.texture_of(mesh.first))});
  }
  return listing;
}

// A table, with the position of its tile below a screen.
std::string text_of(Listing const& listing) {
  std::string text;
  for (auto const& remark : listing.remarks) text += remark + "\n";
  if (!text.empty()) text += "\n";
  return text + table_of(listing.surfaces) + listing.rule +
         fmt::format("{} surfaces\n", listing.surfaces.size());
}

// The same as one JSON document (docs/reference/files.md).
std::string json_text_of(Listing const& listing, std::string const& scene) {
  Json json{{"format", "gpu_shading check 1"}, {"scene", scene}, {"remarks", listing.remarks}};
  json["rule"] = Json::array();
  std::istringstream rule(listing.rule);
  for (std::string line; std::getline(rule, line);) json["rule"].push_back(line);
  json["surfaces"] = Json::array();
  for (auto const& row : listing.surfaces) json["surfaces"].push_back(to_json(row));
  // Names in IDF files may be in Latin-1; in ASCII, control characters of any kind are escaped.
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

// The outlines of the same surfaces, one vertex per line, as comma-separated values.
std::string list_vertices(Scene const& scene, Model const& model) {
  std::string text = "surface,vertex,x [m],y [m],z [m]\n";
  for (auto const id : listed(scene, model)) {
    int number = 0;
    for (auto const& vertex : scene[id].polygon.outline) {
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", csv_quoted(scene[id].name), ++number,
                          vertex.x, vertex.y, vertex.z);
    }
  }
  return text;
}

}  // namespace

std::string perform(ListingTask const& task, SceneAssembly& scene, Messages const& /*messages*/) {
  if (task.vertices) {
    return task.json ? scene_document(scene) : list_vertices(scene.surfaces(), scene.model());
  }
  auto const listing = list_surfaces(scene);
  if (!task.json) return text_of(listing);
  scene.optics().update({});
  return json_text_of(listing, to_text(scene.hash(scene.scene(), {})));
}

}  // namespace gpu_shading::energyplus
