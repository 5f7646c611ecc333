#include "session/listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "base/text.h"
#include "extensions/extension_fields.h"
#include "session/model_rule.h"
#include "session/shade_optics.h"

namespace gpu_shading::energyplus {
namespace {

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
std::string describe_tile(Model const& model, Surface const& surface) {
  auto const screen = model.screens.by_surface.find(surface.name);
  if (screen == model.screens.by_surface.end()) return {};
  auto const axes = tile_axes(surface.polygon, screen->second.maker->placement(surface.polygon));
  return fmt::format("    tile from {} m, u along {}, v along {}\n", place(axes.origin, 3),
                     place(axes.u, 4), place(axes.v, 4));
}

// All surfaces except placeholders, surroundings and mirrored copies that nothing names.
std::vector<SurfaceId> listed(Scene const& scene, Model const& model) {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& name = scene[id].name;
    bool const copy = is_mirrored(name) && !model.shading.wants(name);
    if (!copy && !model.lean.is_placeholder(name) && !model.surroundings.types.contains(name)) {
      ids.push_back(id);
    }
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
    if (type == model.surroundings.types.end() || type->second != extension::geometry::type)
      continue;
    auto const size = area(surface.polygon);
    if (size <= 0.0) continue;
    auto const [row, added] = known.try_emplace(surface.name, rows.size());
    if (added) rows.push_back({id});
    rows[row->second].area += size;
  }
  return rows;
}

// The lines before the table.
std::string remarks_of(Model const& model) {
  std::string text;
  if (!model.lean.remark.empty()) text += model.lean.remark + "\n";
  if (!model.simplified.warning.empty()) text += model.simplified.warning + "\n";
  for (auto const& remark : model.surroundings.remarks) text += remark + "\n";
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted) {
  auto const& input = model.shading;
  auto const ids = listed(scene, model);
  std::size_t width = 0;
  std::size_t kind_width = 0;
  for (auto const id : ids) {
    width = std::max(width, scene[id].name.size());
    kind_width = std::max(kind_width, kind_of(scene[id].name, input).size());
  }
  auto text = remarks_of(model);
  auto const meshes = meshes_of(scene, model);
  for (auto const& mesh : meshes) {
    width = std::max(width, scene[mesh.first].name.size());
    kind_width = std::max(kind_width, kind_of(scene[mesh.first].name, input).size());
  }
  text += fmt::format("{:{}}  {:{}}  {:>12}  {:8}  {}\n", "surface", width, "kind", kind_width,
                      "area [m2]", "receives", "casts");
  for (auto const id : ids) {
    auto const& surface = scene[id];
    auto const size = area(surface.polygon);
    bool const empty = size <= 0.0;
    bool const reveal = kind_of(surface.name, input) == "reveal";
    bool const receives = id < wanted.size() && wanted[id];
    text += fmt::format("{:{}}  {:{}}  {:12.3f}  {:8}  {}\n", surface.name, width,
                        kind_of(surface.name, input), kind_width, size,
                        empty || reveal || !receives ? "no" : "yes",
                        empty                               ? "not (no area)"
                        : surface.casting != Casting::never ? describe_optics(model, surface)
                                                            : "not");
    if (!empty) text += describe_tile(model, surface);
  }
  for (auto const& mesh : meshes) {
    auto const& surface = scene[mesh.first];
    text += fmt::format("{:{}}  {:{}}  {:12.3f}  {:8}  {}\n", surface.name, width,
                        kind_of(surface.name, input), kind_width, mesh.area, "no",
                        describe_optics(model, surface, model.surroundings.texture_of(mesh.first)));
  }
  text += describe(make_shading_rule(input, scene, {}));
  text += fmt::format("{} surfaces\n", ids.size() + meshes.size());
  return text;
}

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

}  // namespace gpu_shading::energyplus
