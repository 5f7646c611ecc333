#include "backends/cpu/cpu_picture_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "filters/perforation/screen_shading.h"
#include "gpu_shading/device.h"
#include "platform/parallel.h"
#include "scene/casters.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"

namespace gpu_shading {

namespace {

// The nearest surface in each pixel of some rows of a square tile, and its depth.
class NearestSurfaces {
 public:
  // None anywhere. Of surfaces whose depths differ by less than `tie` the first to be added has the
  // pixel.
  void start(int side, int first_row, int end_row, double tie) {
    tie_ = tie;
    depths_.start(side, first_row, end_row, std::numeric_limits<double>::infinity());
    numbers_.start(side, first_row, end_row, 0);
  }

  // A piece of a surface whose number is more than 0.
  void add(ConvexArea const& area, DepthPlane const& depth, std::uint32_t number);

  std::span<std::uint32_t> numbers(int row) { return numbers_.row(row); }
  std::span<double> depths(int row) { return depths_.row(row); }

 private:
  double tie_ = 0.0;
  PixelRows<double> depths_;
  PixelRows<std::uint32_t> numbers_;
};

void NearestSurfaces::add(ConvexArea const& area, DepthPlane const& depth, std::uint32_t number) {
  depths_.each_span(area, [&](int row, int first, int length) {
    std::span<double> const depths = depths_.row(row);
    std::span<std::uint32_t> const numbers = numbers_.row(row);
    for (int column = first; column < first + length; ++column) {
      auto const pixel = static_cast<std::size_t>(column);
      double const here = depth.at(column, row);
      if (here + tie_ >= depths[pixel]) continue;
      depths[pixel] = here;
      numbers[pixel] = number;
    }
  });
}

// The square tile whose lower left part a grid is.
int side_of(PictureGrid const& grid) { return std::max(grid.width, grid.height); }

View in_pixels(PictureGrid const& grid) {
  glm::dvec4 const shift(0.0, 0.0, 0.0, 1.0);
  View view = grid.view;
  view.x = 0.5 * grid.width * (view.x + shift);
  view.y = 0.5 * grid.height * (view.y + shift);
  return view;
}

struct Rows {
  int first;
  int end;
};

// Calls use(rows) for parts of a grid, on all cores.
template <typename Use>
void in_rows(PictureGrid const& grid, Use use) {
  constexpr int some = RowSpans::most;
  int const parts = (grid.height + some - 1) / some;
  for_each_index(static_cast<std::size_t>(parts), [&](std::size_t part) {
    int const first = static_cast<int>(part) * some;
    use(Rows{first, std::min(first + some, grid.height)});
  });
}

// The values of a grid's row.
template <typename T>
std::span<T> row_of(std::vector<T>& values, PictureGrid const& grid, int row) {
  auto const width = static_cast<std::size_t>(grid.width);
  return std::span(values).subspan(static_cast<std::size_t>(row) * width, width);
}

void light_all(PixelMask& mask, int side) {
  std::array const corners{glm::dvec2(0.0), glm::dvec2(side, 0.0), glm::dvec2(side),
                           glm::dvec2(0.0, side)};
  mask.light(area_within(corners, side));
}

// Where two surfaces are nearer to each other than this, m, rounding decides which one is seen.
double tie(View const& view) { return clearance * glm::length(glm::dvec3(view.z)); }

// Where a screen may be seen.
struct ScreenExtent {
  Rows rows;
  DepthPlane depth;  // of its polygon

  ScreenExtent(Screens::Entry const& screen, View const& pixels, int height) : rows{} {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    DepthPlane all;
    for (Screens::Quadrilateral const& part : screen.parts) {
      for (glm::dvec3 const& corner : part.corners) {
        for (double const face : {screen.inside, screen.outside}) {
          double const row = at(pixels.y, corner + face * screen.normal - pixels.origin);
          low = std::min(low, row);
          high = std::max(high, row);
        }
      }
      DepthPlane const plane = ProjectedPiece(part.corners, pixels).depth();
      if (&part == &screen.parts.front()) {
        all = plane;
      } else {
        all.nearest = std::min(all.nearest, plane.nearest);
        all.farthest = std::max(all.farthest, plane.farthest);
      }
    }
    depth = all;
    auto const bound = [&](double row) {
      return static_cast<int>(std::clamp(row, 0.0, static_cast<double>(height)));
    };
    rows = {bound(std::floor(low)), bound(std::ceil(high))};
  }
};

// Where a crown may be seen.
Rows rows_of(Crowns::Entry const& crown, View const& pixels, int height) {
  double low = height;
  double high = 0.0;
  for (glm::dvec3 const& corner : crown.corners()) {
    double const row = at(pixels.y, corner - pixels.origin);
    low = std::min(low, row);
    high = std::max(high, row);
  }
  return {static_cast<int>(std::max(0.0, std::floor(low))),
          static_cast<int>(std::min<double>(height, std::ceil(high)))};
}

}  // namespace

CpuPictureRaster::CpuPictureRaster(PictureScene const& scene)
    : transmission_(scene.transmission), coverage_(scene.meshes), surfaces_(scene.scene.size()) {}

int CpuPictureRaster::max_pixels() const { return cpu_device().max_resolution; }

std::vector<CpuPictureRaster::Piece> CpuPictureRaster::lay_out(
    PictureGrid const& grid, std::span<SurfaceId const> surfaces) const {
  View const pixels = in_pixels(grid);
  std::vector<Piece> pieces;
  for (SurfaceId const id : surfaces) {
    coverage_.pieces().each(id, pixels, [&](ProjectedPiece const& piece) {
      ConvexArea const area = piece.area(side_of(grid));
      if (area.first_row < area.end_row) pieces.push_back({area, piece.depth(), id + 1});
    });
  }
  return pieces;
}

std::vector<SheetInBeam> CpuPictureRaster::sheets(PictureGrid const& grid,
                                                  glm::dvec3 const& towards_sun,
                                                  std::span<int const> numbers) const {
  ScreensAtDirection direction{towards_sun, {}, {}};
  for (int const number : numbers) {
    direction.add(number,
                  may_see_effect(transmission_.screens()[number], towards_sun, grid.pixel_area()));
  }
  return transmission_.sheets(direction);
}

std::vector<std::uint32_t> CpuPictureRaster::nearest(PictureGrid const& grid,
                                                     std::span<SurfaceId const> surfaces) {
  std::vector<Piece> const pieces = lay_out(grid, surfaces);
  std::vector<std::uint32_t> seen(grid.pixels());
  in_rows(grid, [&](Rows const& rows) {
    NearestSurfaces nearest;
    nearest.start(side_of(grid), rows.first, rows.end, tie(grid.view));
    for (Piece const& piece : pieces) nearest.add(piece.area, piece.depth, piece.number);
    for (int row = rows.first; row < rows.end; ++row) {
      std::span<std::uint32_t> const to = row_of(seen, grid, row);
      std::copy_n(nearest.numbers(row).begin(), to.size(), to.begin());
    }
  });
  return seen;
}

std::vector<float> CpuPictureRaster::through_bodies(PictureGrid const& grid,
                                                    glm::dvec3 const& towards_sun,
                                                    std::span<SurfaceId const> surfaces) {
  Screens const& screens = transmission_.screens();
  std::vector<int> numbers(screens.entries().size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<SheetInBeam> const in_beam = sheets(grid, towards_sun, numbers);
  View const pixels = in_pixels(grid);
  std::vector<SurfaceId> all_surfaces(surfaces_);
  std::iota(all_surfaces.begin(), all_surfaces.end(), SurfaceId{0});
  std::vector<CrownInBeam> const crowns = transmission_.crowns_among(all_surfaces, towards_sun);
  std::vector<ScreenExtent> extents;
  extents.reserve(numbers.size());
  for (int const number : numbers) extents.emplace_back(screens[number], pixels, grid.height);
  std::vector<Piece> const pieces = lay_out(grid, surfaces);
  std::vector<float> passed(grid.pixels(), 1.0F);
  in_rows(grid, [&](Rows const& all) {
    int const side = side_of(grid);
    NearestSurfaces nearest;
    nearest.start(side, all.first, all.end, tie(grid.view));
    for (Piece const& piece : pieces) nearest.add(piece.area, piece.depth, piece.number);
    PixelMask mask;
    LuminanceTile shaded;
    for (int const number : numbers) {
      ScreenExtent const& extent = extents[static_cast<std::size_t>(number)];
      Rows const rows{std::max(all.first, extent.rows.first), std::min(all.end, extent.rows.end)};
      if (rows.first >= rows.end) continue;
      mask.start(side, rows.first, rows.end);
      light_all(mask, side);
      shaded.start(side, rows.first, rows.end);
      shade_by_screens(shaded, mask, pixels, {&screens, in_beam, {&number, 1}});
      for (int row = rows.first; row < rows.end; ++row) {
        std::span<float const> const by = shaded.row(row);
        std::span<double const> const behind = nearest.depths(row);
        std::span<float> const to = row_of(passed, grid, row);
        for (int column = 0; column < grid.width; ++column) {
          auto const pixel = static_cast<std::size_t>(column);
          auto const bit = static_cast<unsigned>(column % PixelMask::word_bits);
          float const here = (mask.word(row, column) >> bit & 1U) != 0 ? by[pixel] : 0.0F;
          if (here == 1.0F || extent.depth.at(column, row) >= behind[pixel]) continue;
          to[pixel] *= here;
        }
      }
    }
    for (CrownInBeam const& crown : crowns) {
      Rows const extent = rows_of(*crown.crown, pixels, grid.height);
      Rows const rows{std::max(all.first, extent.first), std::min(all.end, extent.end)};
      if (rows.first >= rows.end) continue;
      mask.start(side, rows.first, rows.end);
      light_all(mask, side);
      shaded.start(side, rows.first, rows.end);
      shade_by_crowns(shaded, mask, pixels, {&crown, 1});
      double const depth = at(pixels.z, crown.crown->centre - pixels.origin);
      for (int row = rows.first; row < rows.end; ++row) {
        std::span<float const> const by = shaded.row(row);
        std::span<double const> const behind = nearest.depths(row);
        std::span<float> const to = row_of(passed, grid, row);
        for (std::size_t pixel = 0; pixel < to.size(); ++pixel) {
          if (depth < behind[pixel]) to[pixel] *= by[pixel];
        }
      }
    }
  });
  return passed;
}

std::vector<float> CpuPictureRaster::luminance(PictureGrid const& grid,
                                               ShadedReceiver const& shaded) {
  View const pixels = in_pixels(grid);
  std::vector<SurfaceId> flat;
  std::vector<Shade> shades;
  for (std::size_t i = 0; i < shaded.casters.size(); ++i) {
    if (!transmission_.is_flat(shaded.casters[i])) continue;
    flat.push_back(shaded.casters[i]);
    if (!shaded.shades.empty()) shades.push_back(shaded.shades[i]);
  }
  std::vector<int> const numbers = transmission_.screens_among(shaded.casters);
  std::vector<SheetInBeam> const in_beam = sheets(grid, shaded.towards_sun, numbers);
  std::vector<CrownInBeam> const crowns =
      transmission_.crowns_among(shaded.casters, shaded.towards_sun);
  CastersInView const casters{flat, shades, {{&transmission_.screens(), in_beam, numbers}, crowns}};
  std::vector<float> seen(grid.pixels());
  in_rows(grid, [&](Rows const& rows) {
    int const side = side_of(grid);
    PixelMask lit;
    lit.start(side, rows.first, rows.end);
    light_all(lit, side);
    LuminanceTile luminance;
    luminance.start(side, rows.first, rows.end);
    coverage_.shade(lit, luminance, pixels, casters);
    for (int row = rows.first; row < rows.end; ++row) {
      std::span<float const> const from = luminance.row(row);
      std::span<float> const to = row_of(seen, grid, row);
      for (int column = 0; column < grid.width; ++column) {
        auto const bit = static_cast<unsigned>(column % PixelMask::word_bits);
        if ((lit.word(row, column) >> bit & 1U) == 0) continue;
        to[static_cast<std::size_t>(column)] = from[static_cast<std::size_t>(column)];
      }
    }
  });
  return seen;
}

}  // namespace gpu_shading
