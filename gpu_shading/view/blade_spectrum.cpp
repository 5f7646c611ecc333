#include "view/blade_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

#include "view/convex_area.h"
#include "view/nearest_whole.h"

namespace gpu_shading {
namespace {

glm::dvec2 in_tiles(View const& view, glm::dvec3 const& vector) {
  return 0.5 *
         glm::dvec2(glm::dot(glm::dvec3(view.x), vector), glm::dot(glm::dvec3(view.y), vector));
}

}  // namespace

std::optional<BladeSpectrum> BladeSpectrum::make(Repeat const& repeat, double share,
                                                 View const& view, OutlineSpectrum const& outline) {
  glm::dvec2 const step = in_tiles(view, repeat.step);
  glm::dvec2 const edge = in_tiles(view, repeat.edge);
  double const turn = cross(step, edge);
  constexpr double in_line = 1e-3;
  if (std::abs(turn) <= in_line * glm::length(step) * glm::length(edge)) return std::nullopt;
  // One cycle a step, none along the edge.
  glm::dvec2 const first = glm::dvec2(edge.y, -edge.x) / turn;
  constexpr double most_cycles = 1e9;
  if (!(glm::length(first) < most_cycles)) return std::nullopt;
  return BladeSpectrum(first, share, outline);
}

bool BladeSpectrum::merge(BladeSpectrum const& other) {
  constexpr double in_step = 0.1;
  if (std::min(glm::distance(first_, other.first_), glm::distance(first_, -other.first_)) > in_step)
    return false;
  share_ += other.share_;
  return true;
}

double BladeSpectrum::squared_error(TileGrid const& grid, double enough) const {
  // Vectors at a distance matter to the strongest multiples alone. High multiples matter: the
  // weaker they are, the closer some vector comes, until there are more multiples than pixels.
  constexpr int strongest = 3;
  constexpr int around = 2;
  constexpr int most = 512;
  double const pixels = static_cast<double>(grid.width) * grid.rows;
  int const last = static_cast<int>(
      std::clamp(4.0 * pixels / glm::length(first_), double{strongest}, double{most}));
  double sum = 0.0;
  for (int multiple = 1; multiple <= last && sum < enough; ++multiple) {
    glm::dvec2 const at = static_cast<double>(multiple) * first_;
    auto const column = nearest_whole(at.x / grid.width);
    auto const row = nearest_whole(at.y / grid.rows);
    int const reach = multiple <= strongest ? around : 0;
    double const amplitude = share_ / (std::numbers::pi * multiple);
    for (std::int64_t y = row - reach; y <= row + reach; ++y) {
      for (std::int64_t x = column - reach; x <= column + reach; ++x) {
        if (x == 0 && y == 0) continue;
        glm::dvec2 const vector(static_cast<double>(x * grid.width),
                                static_cast<double>(y * grid.rows));
        double const error = amplitude * outline_.amplitude(at - vector);
        sum += error * error;
      }
    }
  }
  return sum;
}

}  // namespace gpu_shading
