#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "antialias/spectra.h"
#include "geometry/convex_area.h"
#include "platform/instructions.h"

namespace gpu_shading {
namespace {

glm::dvec2 in_tiles(View const& view, glm::dvec3 const& vector) {
  return 0.5 *
         glm::dvec2(glm::dot(glm::dvec3(view.x), vector), glm::dot(glm::dvec3(view.y), vector));
}

struct Blades {
  OutlineSpectrum outline;
  glm::dvec2 first;  // the lowest frequency
  double open;       // times pi
};

// The squared error that a vector of the grid's reciprocal lattice causes at a multiple of the
// frequency, for blades in front of the whole receiver and without the factor 1 / pi.
[[gnu::always_inline]] inline double squared_at(Blades const& blades, glm::dvec2 const& at,
                                                double multiple, TileGrid const& grid,
                                                double column, double row) {
  double const strength = std::min(1.0 / multiple, blades.open);
  double const error = blades.outline.amplitude(at - grid.reciprocal(column, row)) * strength;
  return (column == 0.0) & (row == 0.0) ? 0.0 : error * error;
}

// The vectors around one: two rows and two columns each way.
struct Around {
  static constexpr int reach = 2;
  static constexpr int side = 2 * reach + 1;
  static constexpr int count = side * side;
  std::array<double, count> columns{};
  std::array<double, count> rows{};
};
constexpr Around around = [] {
  Around made;
  std::size_t next = 0;
  for (int row = -Around::reach; row <= Around::reach; ++row) {
    for (int column = -Around::reach; column <= Around::reach; ++column) {
      made.rows[next] = row;
      made.columns[next++] = column;
    }
  }
  return made;
}();

// Of the vectors around a strong multiple.
[[gnu::always_inline]] inline double near_strong(Blades const& blades, TileGrid const& grid,
                                                 int multiple) {
  glm::dvec2 const at = static_cast<double>(multiple) * blades.first;
  double const middle = nearest_whole(at.x / grid.width);
  double const rows = at.y / grid.rows;
  std::array<double, Around::count> squared{};
  for (std::size_t i = 0; i < Around::count; ++i) {
    double const column = middle + around.columns[i];
    double const row = nearest_whole(rows - column * grid.shear) + around.rows[i];
    squared[i] = squared_at(blades, at, multiple, grid, column, row);
  }
  return std::accumulate(squared.begin(), squared.end(), 0.0);
}

// Of the vectors next to some weak multiples, from one on. Written for the compiler to take several
// at a time.
constexpr int at_once = 32;
[[gnu::always_inline]] inline double near_weak(Blades const& blades, TileGrid const& grid,
                                               int from) {
  glm::dvec2 const cell(1.0 / grid.width, 1.0 / grid.rows);
  std::array<double, at_once> squared{};
  for (int i = 0; i < at_once; ++i) {
    auto const multiple = static_cast<double>(from + i);
    glm::dvec2 const at = multiple * blades.first;
    double const column = nearest_whole(at.x * cell.x);
    double const row = nearest_whole(at.y * cell.y - column * grid.shear);
    squared[static_cast<std::size_t>(i)] = squared_at(blades, at, multiple, grid, column, row);
  }
  return std::accumulate(squared.begin(), squared.end(), 0.0);
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
  constexpr double max_cycles = 1e9;
  if (!(glm::length(first) < max_cycles)) return std::nullopt;
  double const covered = std::abs(cross(in_tiles(view, repeat.side), edge) / turn);
  double const open = std::min(covered, std::abs(1.0 - covered));
  glm::dvec2 const along = glm::normalize(edge);
  if (glm::length(edge) >= outline.chord(along)) return BladeSpectrum(first, share, open, outline);
  // Pieces of blades, whose places may differ from blade to blade: a group is as wide as the
  // receiver and as long as a piece.
  glm::dvec2 const across = glm::normalize(step);
  return BladeSpectrum(first, share, open, {outline.chord(across) * across, edge});
}

bool BladeSpectrum::merge(BladeSpectrum const& other) {
  constexpr double in_step = 0.1;
  if (std::min(glm::distance(first_, other.first_), glm::distance(first_, -other.first_)) > in_step)
    return false;
  share_ += other.share_;
  open_ = std::max(open_, other.open_);
  return true;
}

double BladeSpectrum::squared_error(TileGrid const& grid, double enough) const {
  // Grid vectors at a distance matter to the strongest multiples alone.
  constexpr int strongest = 3;
  // High multiples matter: the weaker they are, the closer some vector comes, until there are more
  // multiples than pixels.
  constexpr int max_multiple = 512;
  double const pixels = static_cast<double>(grid.width) * grid.rows;
  int const last = static_cast<int>(std::clamp(4.0 * pixels / glm::length(first_),
                                               double{strongest + at_once}, double{max_multiple}));
  double const amplitude = share_ / std::numbers::pi;
  double const wanted = enough / (amplitude * amplitude);
  Blades const blades{outline_, first_, std::numbers::pi * open_};
  double sum = 0.0;
  for (int multiple = 1; multiple <= strongest; ++multiple) {
    sum += run<near_strong>(blades, grid, multiple);
  }
  for (int from = strongest + 1; from <= last && sum < wanted; from += at_once) {
    sum += run<near_weak>(blades, grid, from);
  }
  return amplitude * amplitude * sum;
}

}  // namespace gpu_shading
