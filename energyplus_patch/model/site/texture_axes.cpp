#include "model/site/texture_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace gpu_shading::energyplus {
namespace {

// Tolerance of right angles between axes, in degrees: for a tile with 100 holes per row, it moves
// the last one by a hole.
constexpr double askew = 0.5;

void check_axes(std::string const& name, std::optional<TextureAxes> const& axes) {
  if (!axes) {
    throw Error(fmt::format(
        "{} has triangles without texture coordinates, which a screen on a mesh needs", name));
  }
  double const cosine = glm::dot(glm::normalize(axes->u), glm::normalize(axes->v));
  double const angle = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
  if (std::abs(angle - 90.0) > askew) {
    throw Error(
        fmt::format("{}: its texture's axes are at {:.1f} degrees to one another, expected "
                    "a right angle",
                    name, angle));
  }
}

// The sizes of a screen's tiles; the renderer treats each size as a separate screen.
class TileSizes {
 public:
  void add(TextureAxes const& axes) {
    double const width = glm::length(axes.u);
    double const height = glm::length(axes.v);
    auto const same = [](double a, double b) { return std::abs(a - b) <= same_scale * b; };
    for (auto const& [w, h] : sizes_) {
      if (same(w, width) && same(h, height)) return;
    }
    constexpr std::size_t max_sizes = 64;
    sizes_.emplace_back(width, height);
    if (sizes_.size() > max_sizes) {
      throw Error(fmt::format(
          "the mesh's texture coordinates give tiles of more than {} sizes, from "
          "{:.4g} x {:.4g} m to {:.4g} x {:.4g} m: give Tile Width and Tile Height",
          max_sizes, std::ranges::min_element(sizes_)->first,
          std::ranges::min_element(sizes_)->second, std::ranges::max_element(sizes_)->first,
          std::ranges::max_element(sizes_)->second));
    }
  }

 private:
  std::vector<std::pair<double, double>> sizes_;
};

}  // namespace

std::optional<TextureAxes> texture_axes(std::array<glm::dvec3, 3> const& corners,
                                        std::array<glm::dvec2, 3> const& texture) {
  auto const b = corners[1] - corners[0];
  auto const c = corners[2] - corners[0];
  auto const tb = texture[1] - texture[0];
  auto const tc = texture[2] - texture[0];
  double const twice = tb.x * tc.y - tc.x * tb.y;
  constexpr double thinnest = 1e-9;
  if (!(std::abs(twice) > thinnest * (glm::dot(tb, tb) + glm::dot(tc, tc)))) return std::nullopt;
  TextureAxes axes;
  axes.u = (tc.y * b - tb.y * c) / twice;
  axes.v = (tb.x * c - tc.x * b) / twice;
  axes.origin = corners[0] - texture[0].x * axes.u - texture[0].y * axes.v;
  return axes;
}

void check_textures(Surroundings const& surroundings, PerforatedScreens const& screens) {
  std::map<ScreenMaker const*, TileSizes> sizes;
  for (auto const& caster : surroundings.casters) {
    auto const& name = caster.surface.name;
    auto const screen = screens.by_surface.find(name);
    if (screen == screens.by_surface.end() || area(caster.surface.polygon) <= 0.0) continue;
    auto const& maker = *screen->second.maker;
    try {
      check_axes(name, caster.texture);
      if (maker.stretches()) sizes[&maker].add(*caster.texture);
    } catch (Error const& error) {
      throw screen_error(maker.where(), error.what());
    }
  }
}

}  // namespace gpu_shading::energyplus
