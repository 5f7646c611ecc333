#include "scene/turns.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace gpu_shading {
namespace {

constexpr int entries = 1024;

using InStep = std::array<float, turns>;

// Of a unit vector along an edge.
InStep in_step_of(glm::dvec2 const& edge) {
  // An edge that crosses fewer rows than this share of them meets their samples unevenly.
  constexpr double nearly = 0.05;
  constexpr int farthest = 2;
  InStep values{};
  for (std::size_t turn = 0; turn < turns; ++turn) {
    double const slope = turn_slopes.at(turn);
    glm::dvec2 const row = glm::normalize(glm::dvec2(1.0, -slope));
    glm::dvec2 const column(-row.y, row.x);
    for (int p = -farthest; p <= farthest; ++p) {
      for (int q = 0; q <= farthest; ++q) {
        glm::dvec2 const step = static_cast<double>(p) * row + static_cast<double>(q) * column;
        double const length = glm::length(step);
        if (length == 0.0) continue;
        double const across = std::abs(step.x * edge.y - step.y * edge.x);
        auto const value = static_cast<float>((1.0 - across / nearly) / length);
        values.at(turn) = std::max(values.at(turn), value);
      }
    }
  }
  return values;
}

// By direction, from 0 at x to 1 at -x along the square whose corners are on the axes.
double position_of(glm::dvec2 const& edge) {
  double const x = edge.y < 0.0 ? -edge.x : edge.x;
  return 0.5 - 0.5 * x / (std::abs(edge.x) + std::abs(edge.y));
}

std::vector<InStep> make_table() {
  std::vector<InStep> table;
  table.reserve(entries);
  for (int i = 0; i < entries; ++i) {
    double const x = 1.0 - 2.0 * (i + 0.5) / entries;
    table.push_back(in_step_of(glm::normalize(glm::dvec2(x, 1.0 - std::abs(x)))));
  }
  return table;
}

}  // namespace

InStep const& in_step(glm::dvec2 const& edge) {
  static std::vector<InStep> const table = make_table();
  auto const entry = static_cast<std::size_t>(position_of(edge) * entries);
  return table[std::min<std::size_t>(entry, entries - 1)];
}

}  // namespace gpu_shading
