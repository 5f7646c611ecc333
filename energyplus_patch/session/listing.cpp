#include "session/listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::string place(glm::dvec3 const& point, int digits) {
  double const scale = std::pow(10.0, digits);
  // No -0.
  auto const rounded = [&](double value) { return std::round(value * scale) / scale + 0.0; };
  return fmt::format("({0:.{3}f}, {1:.{3}f}, {2:.{3}f})", rounded(point.x), rounded(point.y),
                     rounded(point.z), digits);
}

// Where a screen's texture or pattern lies, for the user who has to align it.
std::string describe_tile(Model const& model, Surface const& surface) {
  auto const screen = model.screens.by_surface.find(surface.name);
  if (screen == model.screens.by_surface.end()) return {};
  auto const axes = tile_axes(surface.polygon, screen->second.maker->placement(surface.polygon));
  return fmt::format("    tile from {} m, u along {}, v along {}\n", place(axes.origin, 3),
                     place(axes.u, 4), place(axes.v, 4));
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
                        : surface.casting != Casting::never ? describe_optics(model, surface)
                                                            : "not");
    if (!empty) text += describe_tile(model, surface);
  }
  text += fmt::format("{} surfaces\n", wanted.size());
  return text;
}

}  // namespace gpu_shading::energyplus
