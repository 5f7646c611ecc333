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

}  // namespace

std::string list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted) {
  auto const& input = model.shading;
  std::size_t width = 0;
  std::size_t kind_width = 0;
  for (SurfaceId id = 0; id < wanted.size(); ++id) {
    width = std::max(width, scene[id].name.size());
    kind_width = std::max(kind_width, kind_of(scene[id].name, input).size());
  }
  auto text = fmt::format("{:{}}  {:{}}  {:>12}  {:8}  {}\n", "surface", width, "kind", kind_width,
                          "area [m2]", "receives", "casts");
  for (SurfaceId id = 0; id < wanted.size(); ++id) {
    auto const& surface = scene[id];
    auto const size = area(surface.polygon);
    bool const empty = size <= 0.0;
    bool const reveal = kind_of(surface.name, input) == "reveal";
    text += fmt::format("{:{}}  {:{}}  {:12.3f}  {:8}  {}\n", surface.name, width,
                        kind_of(surface.name, input), kind_width, size,
                        empty || reveal || !wanted[id] ? "no" : "yes",
                        empty                               ? "not (no area)"
                        : surface.casting != Casting::never ? describe_optics(model, surface.name)
                                                            : "not");
  }
  text += fmt::format("{} surfaces\n", wanted.size());
  return text;
}

}  // namespace gpu_shading::energyplus
