#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backends/cpu/crowd_raster.h"
#include "backends/cpu/lit_crowds.h"
#include "backends/cpu/replicates.h"
#include "backends/cpu/surface_pieces.h"
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
  // Of `surfaces`, where they are needed several times.
  std::span<std::vector<ShadedArea> const> areas = {};
  // Where `surfaces` are only a sample: rasterises all of them, which are opaque.
  CrowdRaster const* crowd = nullptr;
  CrowdQuestion question = {};
  LitCrowds* known = nullptr;  // of a window, about which there will be another question
};

// Whether all are shades of few transmittances, which ShadeCounts takes.
bool can_be_counted(CastersInView const& casters);

// A view at the samples of a grid.
struct SampledView {
  TileGrid grid;
  double slope = 0.0;               // of the tile's turn
  std::vector<ConvexArea> outline;  // the receiver
  View in_front;                    // x and y in columns and rows
  bool through = false;             // the receiver is a window in front of these surfaces:
  std::span<SurfaceId const> interiors;
  View behind;  // of a window
};

// Rasterises views on the CPU: as a rasteriser of triangles does, but with a bit for each pixel and
// by convex pieces, and in double precision up to the edges. In place of OpenGL without a GPU it
// takes a tenth of the time (tests/bench/opaque_cost). Any number of threads may ask.
class Coverage {
 public:
  // `meshes`: of all surfaces, by id; not referenced later.
  explicit Coverage(std::span<Mesh const> meshes) : pieces_(meshes) {}

  SurfacePieces const& pieces() const { return pieces_; }

  // What reaches a receiver, or each of the interior surfaces, row by row: a sample behind a window
  // belongs to the nearest of them, and of several in one place to the first. `counted`:
  // can_be_counted(). On so many threads at most; the same on any number.
  RowSums rows(SampledView const& view, CastersInView const& casters, bool counted,
               int threads) const;

  // Some rows of pixels as `pixels`, a view whose x and y are in pixels, has the casters: takes
  // those that opaque casters cover from the mask, and multiplies the luminance by what the others
  // let through.
  void shade(PixelMask& mask, LuminanceTile& shaded, View const& pixels,
             CastersInView const& casters) const;

 private:
  struct InteriorPiece;
  struct Band;

  // Covers the samples of a mask, in pixels, and calls dim(area, shade) for the pieces of casters
  // that transmit.
  template <typename Dim>
  void cover(PixelMask& mask, int side, View const& pixels, CastersInView const& casters,
             Dim dim) const;
  // The areas of all casters for cover(). On so many threads.
  std::vector<std::vector<ShadedArea>> areas(int side, View const& pixels,
                                             CastersInView const& casters, int threads) const;
  // Calls use(area, shade) for the pieces of some casters.
  template <typename Use>
  void each_area(int side, View const& pixels, CastersInView const& casters, Range const& some,
                 Use use) const;
  // Of a crowd. On so many threads.
  void darken(PixelMask& mask, SampledView const& view, CastersInView const& casters,
              int threads) const;

  // Where each piece of the interior surfaces is.
  std::vector<InteriorPiece> interior_pieces(SampledView const& view) const;
  // Calls use(band) for the rows of a mask, in order, with each sample in one piece: where several
  // are, in the nearest.
  template <typename Use>
  static void each_band(PixelMask const& lit, std::span<InteriorPiece const> pieces, Use use);
  static void keep_nearest(Band& band, std::size_t word, int bit);

  SurfacePieces pieces_;
};

}  // namespace gpu_shading
