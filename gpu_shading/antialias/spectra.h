#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "antialias/antialias.h"
#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "geometry/plane_frame.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// The nearest whole number, for numbers below 2^51, by adding a large number and subtracting it
// again. Unlike std::round, it needs no call on older processors, and compilers vectorise it.
inline double nearest_whole(double x) {
  constexpr double rounding = 0x1.8p52;
  return (x + rounding) - rounding;
}

// Upper limit of the Fourier transform of a receiver that fills its bounding rectangle, or of
// another parallelogram. Frequencies are in cycles per tile.
class OutlineSpectrum {
 public:
  // Of a parallelogram, by its sides in tiles.
  OutlineSpectrum(glm::dvec2 const& u, glm::dvec2 const& v)
      : u_(std::numbers::pi * u), v_(std::numbers::pi * v) {}
  // On a tile that is not stretched, by the slope of its turn.
  explicit OutlineSpectrum(double slope) {
    double const c = 1.0 / std::sqrt(1.0 + slope * slope);
    double const s = slope * c;
    double const side = std::numbers::pi / (c + std::abs(s));
    u_ = side * glm::dvec2(c, s);
    v_ = side * glm::dvec2(-s, c);
  }
  OutlineSpectrum(TileMap const& map, PlaneFrame const& frame)
      : u_(0.5 * std::numbers::pi * frame.width * map.matrix[0]),
        v_(0.5 * std::numbers::pi * frame.height * map.matrix[1]) {}

  // On a tile of another shape. `change`: of frequencies.
  void change(glm::dmat2 const& change) {
    glm::dmat2 const of_sides = glm::inverse(glm::transpose(change));
    u_ = of_sides * u_;
    v_ = of_sides * v_;
  }

  // The longest part within a rectangle of a line in a direction of length 1, in tiles.
  double chord(glm::dvec2 const& direction) const {
    double const u = std::abs(glm::dot(u_, direction)) / glm::dot(u_, u_);
    double const v = std::abs(glm::dot(v_, direction)) / glm::dot(v_, v_);
    return 1.0 / (std::numbers::pi * std::max(u, v));
  }

  double amplitude(glm::dvec2 const& frequency) const {
    double const u = std::abs(glm::dot(u_, frequency));
    double const v = std::abs(glm::dot(v_, frequency));
    return 1.0 / (std::max(1.0, u) * std::max(1.0, v));
  }
  // Its inverse, by no branch and no division.
  double decay(glm::dvec2 const& frequency) const {
    double const u = std::abs(glm::dot(u_, frequency));
    double const v = std::abs(glm::dot(v_, frequency));
    return at_least_1(u) * at_least_1(v);
  }

 private:
  static double at_least_1(double value) { return 0.5 * (value + 1.0 + std::abs(value - 1.0)); }

  glm::dvec2 u_;  // sides of the rectangle, in tiles, times pi
  glm::dvec2 v_;
};

// The frequencies in a view of blades at equal distances, such as louvres or fins, in cycles per
// tile: multiples of one.
class BladeSpectrum {
 public:
  // `first`: the lowest frequency. `share`: of the receiver, behind these blades. `open`: of the
  // distance between two, what is open or, if that is less, covered. `outline`: of a group of
  // blades.
  BladeSpectrum(glm::dvec2 const& first, double share, double open, OutlineSpectrum const& outline)
      : outline_(outline), first_(first), share_(share), open_(open) {}

  // Empty for blades in line, end to end, or too close together.
  static std::optional<BladeSpectrum> make(Repeat const& repeat, double share, View const& view,
                                           OutlineSpectrum const& outline);

  // Adds the share of another spectrum that is in step with this one all over the tile. False if it
  // is not.
  bool merge(BladeSpectrum const& other);

  // The same on a tile of another shape. `change`: of frequencies.
  void change(glm::dmat2 const& change) {
    first_ = change * first_;
    outline_.change(change);
  }

  // Upper bound of the squared error of the mean over a grid, or any number above `enough`.
  double squared_error(TileGrid const& grid, double enough) const;

 private:
  OutlineSpectrum outline_;
  glm::dvec2 first_;
  double share_;
  double open_;
};

// Whether two screens have the same holes and directions of holes, and so the same spectrum, as the
// panels of a facade do.
bool alike(Screens::Entry const& a, Screens::Entry const& b);

// The frequencies of a screen's holes in a view, in cycles per tile.
class HoleSpectrum {
 public:
  HoleSpectrum(Screens::Entry const& screen, SheetInBeam const& sheet, View const& view,
               OutlineSpectrum const& outline);

  // The same on a tile of another shape, with its outline. `change`: of frequencies.
  void change(glm::dmat2 const& change, OutlineSpectrum const& outline);

  // Upper limit of the squared error of the mean that a row of vectors of a grid's reciprocal
  // lattice causes, each by the holes' nearest frequency. Errors of single vectors up to
  // `negligible` may be left out.
  double squared_error(TileGrid const& grid, int row, double negligible) const;
  // The number of rows from 0 that matter; beyond, errors are small.
  static int rows(TileGrid const& grid) { return is_large(grid) ? max_rows : 25; }
  // Whether a grid has so many places that errors of high frequencies matter, which are small.
  static bool is_large(TileGrid const& grid) {
    constexpr double large = 1000.0 * 1000.0;
    return static_cast<double>(grid.width) * grid.rows > large;
  }

  // The same of the rest of the grid's vectors, by frequencies next to the lines across straight
  // sides, which fade slowly. 0 for a grid that is not large.
  double squared_error_across_sides(TileGrid const& grid, double negligible) const;

 private:
  static constexpr int max_rows = 49;

  void describe(PerforatedScreen const& screen, SheetInBeam const& sheet);
  // Of the frequency with an index, by the nearest vector of a grid, if that is in none of its
  // rows.
  double squared_error_of(glm::dvec2 const& index, TileGrid const& grid, double negligible) const;
  // Of a frequency per m, in the sheet.
  double amplitude(glm::dvec2 const& frequency) const;

  OutlineSpectrum outline_;
  double open_;
  glm::dmat2 lowest_{1.0};  // from the index of a frequency to the frequency, per m, in the sheet
  glm::dmat2 basis_{1.0};   // and in the view
  glm::dmat2 to_index_{1.0};
  double per_area_ = 0.0;          // holes per m2
  double arcs_ = 0.0;              // of a hole
  std::vector<glm::dvec2> sides_;  // one of each two that are parallel
  double size_ = 0.0;              // of a hole
  double max_scale_ = 0.0;         // limit of any amplitude times its frequency, per m
};

}  // namespace gpu_shading
