#include "raster_cpu/screen_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "view/convex_area.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

// Frequencies are in cycles per tile.

// Upper limit of the transform of a receiver that fills its bounding rectangle, which lies on the
// tile at a golden slope (TileMap).
double receiver_amplitude(glm::dvec2 const& frequency) {
  static double const angle = std::atan(1.0 / std::numbers::phi);
  static double const c = std::cos(angle);
  static double const s = std::sin(angle);
  static double const width = pi / (c + s);
  double const u = width * std::abs(c * frequency.x + s * frequency.y);
  double const v = width * std::abs(c * frequency.y - s * frequency.x);
  return 1.0 / (std::max(1.0, u) * std::max(1.0, v));
}

// Avoids a call, which std::round is on older processors.
std::int64_t nearest_whole(double x) {
  return static_cast<std::int64_t>(x + (x < 0.0 ? -0.5 : 0.5));
}

// The holes of a screen as a view has them.
class Holes {
 public:
  Holes(Screens::Entry const& screen, SheetInBeam const& sheet, View const& view)
      : staggered_(sheet.staggered && sheet.shape != SheetShape::image),
        open_(screen.screen->open_fraction()),
        tile_(sheet.tile) {
    glm::dvec3 const x(view.x);
    glm::dvec3 const y(view.y);
    glm::dmat2 const to_place =
        2.0 * glm::inverse(glm::dmat2(glm::dot(x, screen.u), glm::dot(y, screen.u),
                                      glm::dot(x, screen.v), glm::dot(y, screen.v)));
    basis_ = glm::transpose(to_place) * glm::dmat2(1.0 / tile_.x, 0.0, 0.0, 1.0 / tile_.y);
    to_index_ = glm::inverse(basis_);
    describe(*screen.screen, sheet);
  }

  // Upper limit of the error that a vector of a grid's reciprocal lattice causes.
  double error_at(glm::dvec2 const& vector) const {
    glm::dvec2 const at = to_index_ * vector;
    glm::dvec2 const frequency = at / tile_;
    if (glm::dot(frequency, frequency) > highest_) return 0.0;
    std::int64_t column = nearest_whole(at.x);
    std::int64_t row = nearest_whole(at.y);
    if (staggered_ && ((column + row) & 1) != 0) {
      glm::dvec2 const rest(at.x - static_cast<double>(column), at.y - static_cast<double>(row));
      if (std::abs(rest.x) > std::abs(rest.y)) {
        column += rest.x > 0.0 ? 1 : -1;
      } else {
        row += rest.y > 0.0 ? 1 : -1;
      }
    }
    glm::dvec2 const nearest(static_cast<double>(column), static_cast<double>(row));
    if (nearest == glm::dvec2(0.0)) return 0.0;
    return amplitude(nearest / tile_) * receiver_amplitude(basis_ * (at - nearest));
  }

  struct Frequency {
    glm::dvec2 at;
    double amplitude;
  };
  // The lowest of all holes.
  std::vector<Frequency> lowest() const {
    constexpr int most = 3;
    std::vector<Frequency> found;
    for (int row = -most; row <= most; ++row) {
      for (int column = -most; column <= most; ++column) {
        bool const odd = staggered_ && (column + row) % 2 != 0;
        if (odd || (column == 0 && row == 0)) continue;
        glm::dvec2 const index(column, row);
        found.push_back({basis_ * index, amplitude(index / tile_)});
      }
    }
    return found;
  }

 private:
  void describe(PerforatedScreen const& screen, SheetInBeam const& sheet) {
    double const half = sheet.half_hole;
    double const area = tile_.x * tile_.y;
    per_area_ = (staggered_ ? 2.0 : 1.0) / area;
    double size = 2.0 * half;
    switch (sheet.shape) {
      case SheetShape::square_holes:
        sides_ = {{2.0 * half, 0.0}, {0.0, 2.0 * half}};
        break;
      case SheetShape::hexagonal_holes: {
        double const side = 2.0 * half / std::numbers::sqrt3;
        sides_ = {{0.0, side},
                  {std::numbers::sqrt3 / 2.0 * side, side / 2.0},
                  {std::numbers::sqrt3 / 2.0 * side, -side / 2.0}};
        break;
      }
      case SheetShape::round_holes:
        arcs_ = std::sqrt(half) / pi;
        if (sheet.half_slot > 0.0F) sides_ = {{2.0 * static_cast<double>(sheet.half_slot), 0.0}};
        break;
      case SheetShape::image:
        size = screen.hole();
        arcs_ = std::sqrt(size / 2.0) / pi;
        per_area_ = open_ / (pi / 4.0 * size * size);
        break;
    }
    constexpr double highest_in_holes = 60.0;
    highest_ = highest_in_holes * highest_in_holes / (size * size);
  }

  // Upper limit of the transform of all holes: of their straight sides, and of their arcs.
  double amplitude(glm::dvec2 const& frequency) const {
    double const squared = glm::dot(frequency, frequency);
    double sum = arcs_ / std::sqrt(squared * std::sqrt(squared));
    for (glm::dvec2 const& side : sides_) {
      double const along = pi * std::abs(glm::dot(side, frequency));
      sum += std::abs(cross(side, frequency)) / (pi * squared * std::max(1.0, along));
    }
    return std::min(open_, per_area_ * sum);
  }

  bool staggered_;
  double open_;
  glm::dvec2 tile_;
  glm::dmat2 basis_{1.0};  // of the frequencies of holes
  glm::dmat2 to_index_{1.0};
  double per_area_ = 0.0;          // holes per m2
  double arcs_ = 0.0;              // of a hole
  std::vector<glm::dvec2> sides_;  // one of each two that are parallel
  double highest_ = 0.0;           // frequency that matters, per m, squared
};

// Screens with the same holes and directions of holes, as the panels of a facade have them.
struct AlikeScreens {
  Screens::Entry const* first;
  Holes holes;
  int count;

  bool include(Screens::Entry const& screen) const {
    constexpr double alike = 1e-9;
    return screen.screen == first->screen && glm::length(screen.u - first->u) < alike &&
           glm::length(screen.v - first->v) < alike;
  }
};

// Upper limit of the squared error of a grid, or anything above `enough`.
double squared_error(TileGrid const& grid, std::span<AlikeScreens const> screens, double enough) {
  constexpr int order = 12;  // straight sides have high frequencies too
  double sum = 0.0;
  for (int row = 0; row <= order && sum < enough; ++row) {
    for (int column = row == 0 ? 1 : -order; column <= order; ++column) {
      glm::dvec2 const vector(column * grid.width, row * grid.rows);
      for (auto const& [first, holes, count] : screens) {
        double const error = holes.error_at(vector);
        sum += count * error * error;
      }
    }
  }
  return sum;
}

// The same for two screens, whose frequencies add up where a ray passes both.
double squared_error(TileGrid const& grid, Holes const& first, Holes const& second, double enough) {
  constexpr int order = 3;
  double sum = 0.0;
  for (Holes::Frequency const& frequency : first.lowest()) {
    for (int row = -order; row <= order && sum < enough; ++row) {
      for (int column = -order; column <= order; ++column) {
        if (column == 0 && row == 0) continue;
        glm::dvec2 const vector(column * grid.width, row * grid.rows);
        double const error = frequency.amplitude * second.error_at(vector - frequency.at);
        sum += 0.5 * error * error;  // of two that are opposite, each counts
      }
    }
  }
  return sum;
}

// Those of screens whose holes are drawn on a tile with so many pixels a side.
std::vector<AlikeScreens> drawn_holes(View const& view, ScreensInView const& screens, int side) {
  std::vector<AlikeScreens> drawn;
  for (int const number : screens.numbers) {
    Screens::Entry const& screen = (*screens.screens)[number];
    auto const alike = std::find_if(drawn.begin(), drawn.end(),
                                    [&](AlikeScreens const& each) { return each.include(screen); });
    if (alike != drawn.end()) {
      ++alike->count;
      continue;
    }
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    double const pixel = 2.0 / side * drawn_pixel(screens, screen, view);
    bool const known = sheet.shape != SheetShape::image || std::isfinite(screen.screen->hole());
    if (!known || sheet.layers == solid_sheet || pixel >= static_cast<double>(sheet.blend_to))
      continue;
    drawn.push_back({&screen, Holes(screen, sheet, view), 1});
  }
  return drawn;
}

// Whether all screens are patterns, in whose plane a ray takes little time.
bool quick(ScreensInView const& screens) {
  return std::all_of(screens.numbers.begin(), screens.numbers.end(), [&](int number) {
    int const layers = screens.sheets[static_cast<std::size_t>(number)].layers;
    return layers == exact_sheet || layers == solid_sheet;
  });
}

}  // namespace

TileGrid screen_grid(Tile const& tile, View const& view, ScreensInView const& screens) {
  // Over three sets of 200 random screens at 1e-3 (tests/bench/aliasing), 0.03 % of the views are
  // then beyond it. More stretch and trials find grids that alias less by the estimate alone.
  constexpr int trials = 12;
  constexpr double stretch = 0.2;
  constexpr double finer = 1.2;
  auto const holes = drawn_holes(view, screens, tile.side);
  if (holes.empty()) return pixels_of(tile);
  double const side = quick(screens) ? finer * tile.side : tile.side;
  double const enough = 0.015 / tile.side;
  TileGrid best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < trials && least > enough * enough; ++i) {
    TileGrid grid;
    double const share = 1.0 - stretch * std::fmod(i / std::numbers::phi, 1.0);
    grid.rows = static_cast<int>(std::lround(side * share));
    grid.width = static_cast<int>(std::lround(side * side / grid.rows)) + i;
    double squared = squared_error(grid, holes, least);
    // Each with the first one.
    for (std::size_t k = 0; screens.overlap && k < holes.size(); ++k) {
      int const others = k == 0 ? holes[k].count - 1 : holes[k].count;
      if (others == 0) continue;
      squared += others * squared_error(grid, holes[0].holes, holes[k].holes, least);
    }
    if (squared >= least) continue;
    least = squared;
    best = grid;
  }
  return best;
}

}  // namespace gpu_shading
