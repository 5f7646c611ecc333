#include "session/listing.h"

#include <fmt/format.h>

#include <algorithm>

#include "session/shade_optics.h"

namespace gpu_shading::energyplus {
namespace {

std::string kind_of(std::string const& name, ShadingInput const& input) {
  if (name.find(" reveal ") != std::string::npos) return "reveal";
  if (auto const found = input.shading_surfaces.find(name); found != input.shading_surfaces.end()) {
    return found->second.type;
  }
  return input.base_of.contains(name) ? "window or door" : "heat transfer surface";
}

// All but what stands in for surfaces that were left out of EnergyPlus's input.
std::vector<SurfaceId> listed(Scene const& scene, Model const& model) {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (!model.lean.is_placeholder(scene[id].name)) ids.push_back(id);
  }
  return ids;
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
  std::string text = model.lean.remark.empty() ? "" : model.lean.remark + "\n\n";
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
                        : surface.casting != Casting::never ? describe_optics(model, surface.name)
                                                            : "not");
  }
  text += fmt::format("{} surfaces\n", ids.size());
  return text;
}

std::string list_vertices(Scene const& scene, Model const& model) {
  std::string text = "surface,vertex,x [m],y [m],z [m]\n";
  for (auto const id : listed(scene, model)) {
    int number = 0;
    for (auto const& vertex : scene[id].polygon.outline) {
      text += fmt::format("\"{}\",{},{:.9g},{:.9g},{:.9g}\n", scene[id].name, ++number, vertex.x,
                          vertex.y, vertex.z);
    }
  }
  return text;
}

}  // namespace gpu_shading::energyplus
