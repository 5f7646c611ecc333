#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "antialias/antialias.h"
#include "backends/cpu/crowd_raster.h"
#include "backends/cpu/lit_crowds.h"
#include "backends/cpu/passed_schedules.h"
#include "backends/cpu/replicates.h"
#include "backends/cpu/surface_pieces.h"
#include "backends/interface/view_backend.h"
#include "filters/bodies.h"
#include "filters/transmission.h"
#include "geometry/triangulation.h"
#include "gpu_shading/scene.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// A convex piece of a flat caster, in pixels.
struct ShadedArea {
  ConvexArea area;
  Shade shade;
};

// What is in front of a receiver at one direction of the sun.
struct CastersInView {
  std::span<SurfaceId const> surfaces;  // that are flat
  std::span<Shade const> shades;        // of each surface; none where all are opaque
  BodiesInView bodies;
  SampledRepeats repeats = {};  // of surfaces at equal distances
  // Of `surfaces`, where they are needed several times.
  std::span<std::vector<ShadedArea> const> areas = {};
  // Where `surfaces` are only a sample: rasterises all of them, which are opaque.
  CrowdRaster const* crowd = nullptr;
  CrowdQuestion question = {};
  LitCrowds* known = nullptr;         // of a window, about which there will be another question
  std::optional<TileGrid> grid = {};  // the best samples, where they are known

  bool opaque() const { return shades.empty() && bodies.empty(); }
};

// Where a tile is sampled: where it is most accurate, or at the centres of its pixels, as OpenGL
// does.
enum class Samples { fine, pixels };

// What takes least time to sample casters, if no perforated sheet is among them.
SampleUse sample_use(CastersInView const& casters);

// Rasterises views on the CPU: as a rasteriser of triangles does, but with a bit for each pixel and
// by convex pieces, and in double precision up to the edges. In place of OpenGL without a GPU it
// takes a tenth of the time (tests/bench/opaque_cost). Any number of threads may ask.
class Coverage {
 public:
  // `meshes`: of all surfaces, by id; not referenced later.
  explicit Coverage(std::span<Mesh const> meshes) : pieces_(meshes) {}

  SurfacePieces const& pieces() const { return pieces_; }

  // Luminance over a tile's pixels as `view`, in front of its receiver, has the casters, in
  // pixels. On so many threads at most; the same on any number.
  LuminanceSums sums(Tile const& tile, View const& view, CastersInView const& casters,
                     Samples samples, int threads) const;
  // Row by row at the samples of a grid, without schedules. `use`: sample_use() of the casters.
  RowSums rows(TileGrid const& grid, Tile const& tile, View const& view,
               CastersInView const& casters, SampleUse use, int threads) const;
  // The same over those pixels where each of `interiors` is the nearest in the view `behind`; of
  // surfaces in the same place the first has them.
  std::vector<LuminanceSums> sums_inside(Tile const& tile, View const& view,
                                         CastersInView const& casters, Samples samples,
                                         View const& behind,
                                         std::span<SurfaceId const> interiors) const;
  // Row by row at the samples of a grid, with opaque casters.
  RowSums rows_inside(TileGrid const& grid, Tile const& tile, View const& view,
                      CastersInView const& casters, View const& behind,
                      std::span<SurfaceId const> interiors) const;

  // Some rows of pixels as `pixels`, a view whose x and y are in pixels, has the casters: takes
  // those that opaque casters cover from the mask, and multiplies the luminance by what the others
  // let through. `passed` notes scheduled shades; it may be null where there are none.
  void shade(PixelMask& mask, LuminanceTile& shaded, PassedSchedules* passed, View const& pixels,
             CastersInView const& casters) const;

 private:
  struct InteriorPiece;
  struct Band;

  struct Rows;
  struct Projected;

  // Covers the samples of a mask, in pixels, and calls dim(area, shade) for the pieces of casters
  // that transmit. `order` of the casters: none, as they come.
  template <typename Dim>
  void cover(PixelMask& mask, int side, View const& pixels, CastersInView const& casters,
             std::span<std::size_t const> order, Dim dim) const;
  // The areas of all casters, in that order, for cover(). On so many threads.
  std::vector<std::vector<ShadedArea>> areas(int side, View const& pixels,
                                             CastersInView const& casters,
                                             std::span<std::size_t const> order, int threads) const;
  // Calls use(area, shade) for the pieces of casters at some positions of the order.
  template <typename Use>
  void each_area(int side, View const& pixels, CastersInView const& casters,
                 std::span<std::size_t const> order, Range const& positions, Use use) const;
  // Of opaque casters. On so many threads, if they are a crowd.
  void darken(PixelMask& mask, Tile const& tile, TileGrid const& grid, View const& pixels,
              CastersInView const& casters, int threads) const;

  // Where each piece of the interior surfaces is.
  std::vector<InteriorPiece> interior_pieces(TileGrid const& grid, View const& pixels,
                                             std::span<SurfaceId const> interiors) const;
  // Calls use(band) for all rows, in order, with each sample in one piece: where several are, in
  // the nearest.
  template <typename Use>
  static void each_band(TileGrid const& grid, PixelMask const& lit,
                        std::span<InteriorPiece const> pieces, Use use);
  static void keep_nearest(Band& band, std::size_t word, int bit);
  // Add the lit samples of each piece to the sums of its surface, which are by row for the first.
  static void add_lit(PixelMask const& lit, Band const& band, std::span<std::vector<double>> sums);
  static void add_luminance(PixelMask const& lit, LuminanceTile const& shaded,
                            PassedSchedules const& passed, Band const& band,
                            std::span<ScheduledTotals> totals);

  SurfacePieces pieces_;
};

}  // namespace gpu_shading
