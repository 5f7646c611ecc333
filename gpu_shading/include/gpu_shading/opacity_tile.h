#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/hole_pattern.h"

namespace gpu_shading {

// A raster of the tile of a perforated sheet, whose axes and units are as in hole_pattern.h: row
// after row along u, the first at v = 0. Each texel holds the opacity of
// its area, 0 (open) .. solid_texel, for opacities 0 .. 1. Opacity is interpolated bilinearly
// between the centres of texels, across the tile's edges too. A thresholded tile has opacity 1
// where this value is above the threshold and 0 elsewhere, evaluated in single precision as in a
// shader. Other tiles have fractional opacity, which counts once along a ray: the largest value
// applies.
//
// At most max_texels_a_side texels each way. Value type; copies share the texels. Constructors
// throw Error for invalid values, as those of HolePattern do.
class OpacityTile {
 public:
  static constexpr int max_texels_a_side = 16384;
  static constexpr std::uint16_t solid_texel = 65535;

  OpacityTile(double width, double height, int columns, int rows,
              std::vector<std::uint16_t> opacity, std::optional<double> threshold = 0.5);

  // From opacities 0 .. 1, rounded to nearest with halves rounded down, so that 0.5 is not above a
  // threshold of 0.5.
  OpacityTile(double width, double height, int columns, int rows, std::vector<float> const& opacity,
              std::optional<double> threshold = 0.5);

  // Rasterises a pattern. Each texel holds its solid fraction or, with a threshold, the solid
  // fraction of an area twice as wide and high about its centre, because only then do interpolated
  // edges coincide with the edges of holes. Both use 256 points per texel. Texels are as close to
  // `texel` in size as a whole number of them in the tile allows.
  OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold = 0.5);

  // The same image over another tile; shares the memory of the texels.
  OpacityTile stretched(double width, double height) const;

  double width() const { return width_; }
  double height() const { return height_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double texel_width() const { return width_ / columns_; }
  double texel_height() const { return height_ / rows_; }
  std::span<std::uint16_t const> opacity() const { return *opacity_; }
  std::optional<double> threshold() const { return threshold_; }

  // Mean open fraction of the texels, after applying the threshold if there is one.
  double open_fraction() const;

  // The longest step in the plane that steps over almost no web between holes: at most 2e-3 of all
  // rays in any direction step over the first web on their way. Stray texels (up to one in 10000),
  // frayed edges (noise of 0.05 in opacity) and narrow webs in an equally small part of the tile do
  // not shorten it; where all webs are equally wide, it steps over none. Webs are where the
  // interpolated opacity is above the threshold or, for fractional opacity, above levels between 0
  // and 1, one for each ray. They are met by 4096 rays in each of eight directions, and the result
  // is 2 % below the shortest of their steps. Infinite if there is no web.
  double web() const { return web_; }

  // The size of a typical hole: the mean length of runs of open texels along rows and columns.
  // Infinite if everything is solid or everything is open.
  double hole() const;

 private:
  void find_web();

  double width_ = 0.0;
  double height_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::shared_ptr<std::vector<std::uint16_t> const> opacity_;
  std::optional<double> threshold_;
  double web_ = 0.0;
};

}  // namespace gpu_shading
