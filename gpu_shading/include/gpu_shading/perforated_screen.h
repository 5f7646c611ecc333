#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/perforation.h"

// The optics of a perforated sheet: what of the beam passes it, edges of the sheet aside.
//
// Lengths and places in the sheet's plane are as in perforation.h. Directions are theta, the angle
// of incidence from the normal, 0 .. pi/2, and phi, the angle in the plane from u towards v of the
// beam's projection, both in radians. A beam and its reverse pass alike, so that phi and phi + pi
// are one and both faces have the same transmittance.
//
// Walls are straight and black: a ray passes where every point of its way, (u, v) to (u, v) +
// thickness tan(theta) (cos(phi), sin(phi)), is open. That length is the shift.
//
// Constructors and functions throw Error where what they are given makes no screen; the message
// begins with the field, as in "thickness is -1 m, expected 0 or more".

namespace gpu_shading {

// Layers that stand for a sheet at a shift, front and back counted: 1 + ceil(shift / web), so that
// no ray steps over a web of that width, `most` at most; 0 past the longest way through a hole,
// where the sheet is solid. `web` above 0, infinite allowed, shifts from 0. Round, square and
// hexagonal holes of 64 texels, drawn so, are within 2e-3 of the closed form over theta 0 .. 85
// degrees, on average 9e-4. With OpacityTile::web(), which leaves out the narrowest 3 %, images
// with texels astray take as many layers as clean ones and are as near; where one web is far
// narrower than the rest, rays step over it.
int layers_for(double shift, double web, double longest_chord, int most = 64);

// Share of the beam that `layers` equidistant copies of the tile over the thickness let pass, at
// four rays for each texel: what a renderer of layers draws at twice the tile's resolution. No
// layers: 0.
double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi);

// tau(theta, phi) of a sheet as a table of 120 directions phi over pi, equal steps of the shift in
// each, linear between them.
//
// From a pattern: the closed form at 512 steps, within 1e-3 of it, 1e-5 for round holes; squares
// end at different shifts from one phi to the next.
//
// From a tile: by following rays from open places, spread evenly over each region, to where they
// meet a solid place, at steps of a texel where something is near (half a web or less, so that none
// is stepped over). 4096 rays a region in each direction, fewer where that would take more than a
// few seconds, 32 at least; of several regions every fourth direction, linear between these. With
// holes of 40 texels a thousand rays or more are within 5e-3 of the closed form in each region;
// 400, which 1024 regions get, within 1e-2 where a region holds few holes, 4e-2 at worst where it
// holds 64 of them. The mean is within 2e-3, on average 5e-4. Rasters of coarser holes are
// themselves farther from the closed form, 8e-3 at 10 texels. One region takes a tenth of a second,
// 512 x 512 texels a third, larger ones some 3 to 5 s on one core, shared out to those there are;
// regions take at most 48 MiB.
//
// Rays are followed for 64 thicknesses (89.1 degrees), and at most for eight widths and heights of
// the tile. A way that does not end there (slats, or a hole so long) lets as much pass farther;
// near such a direction the table is coarse. Steps are a 64th of the mean way, or longer where the
// longest way asks for it, up to a 16th; the table holds its last value from its end to the longest
// chord. Of fractional opacity, less than half a step of 8 bits is taken as nothing.
//
// A value: safe to share between threads.
class ScreenTransmittance {
 public:
  // A thickness of 0 is allowed: the open fraction at every angle.
  ScreenTransmittance(HolePattern const& pattern, double thickness);
  ScreenTransmittance(OpacityTile const& tile, double thickness);

  // Angles theta outside 0 .. pi/2 are taken at the nearest end; any phi.
  double operator()(double theta, double phi) const;

  double thickness() const { return thickness_; }
  double open_fraction() const { return values_.front(); }

  // The shift from which nothing passes in any direction phi, anywhere, within a step; 0 where
  // nothing passes at all, infinite where a way does not end.
  double longest_chord() const { return longest_chord_; }
  // tan(theta) = longest chord / thickness.
  double cut_off() const;

  // The table as a texture: directions() rows, phi from 0 in steps of pi / directions(), which
  // repeat, and steps() columns, the shift from 0 in steps of step().
  static constexpr int directions() { return 120; }
  int steps() const { return steps_; }
  double step() const { return step_; }
  std::span<float const> values() const { return values_; }

  // Equal parts of the tile, across in u and up in v, whose transmittances differ. One of patterns,
  // and of tiles of up to 256 texels both ways; else one for 128 texels, to the nearest, 32 at most
  // each way. What lies between regions' centres is for a reader to interpolate bilinearly, across
  // the tile's edges too.
  int regions_across() const { return regions_across_; }
  int regions_up() const { return regions_up_; }

  // Each region's transmittance for a shift in m from 0, row after row along u, the first at v = 0:
  // of rays that begin in it as phi goes from 0 to pi. Interpolated as operator() is, which gives
  // their mean. With a thickness of 0 as at no shift.
  std::vector<float> at_shift(double shift, double phi) const;

 private:
  int regions() const { return regions_across_ * regions_up_; }
  double at(double shift, double phi) const;
  // At a shift of so many steps, where there are several.
  std::vector<float> of_regions(double place, double phi) const;

  double thickness_ = 0.0;
  double step_ = 0.0;
  int steps_ = 0;
  double longest_chord_ = 0.0;
  std::vector<float> values_;
  int regions_across_ = 1;
  int regions_up_ = 1;
  int region_directions_ = 0;
  // Of several regions: all at each step, of these all in each direction.
  std::vector<float> region_values_;
};

// Where in a sheet the polygon of its surface lies. The outside is the side that the polygon's
// normal points to.
enum class SheetPlane { centre, outside, inside };

// How a screen is drawn.
enum class ScreenDetail {
  automatic,  // holes up to pixels of one hole, effective from two on; between, a blend
  holes,      // hole by hole, whatever the size of pixels
  effective,  // by tau(theta, phi)
};

struct Sheet {
  double thickness = 0.0;  // m, 0 allowed
  SheetPlane plane = SheetPlane::centre;
  // Copies of the sheet's holes over its thickness that a ray has to pass, front and back counted,
  // 1 .. 64. Nothing: as many as are needed. Of a pattern that is none: a ray passes where it is in
  // the same hole at both faces, which is exact, since holes are convex. Of a raster: layers_for.
  std::optional<int> layers = std::nullopt;
  ScreenDetail detail = ScreenDetail::automatic;
};

// A perforated sheet of any extent, repeated over the surfaces that it is on. Safe to share between
// threads.
class PerforatedScreen {
 public:
  PerforatedScreen(HolePattern const& pattern, Sheet const& sheet);
  PerforatedScreen(OpacityTile tile, Sheet const& sheet);

  Sheet const& sheet() const { return sheet_; }
  // One of them is there.
  std::optional<HolePattern> const& pattern() const { return pattern_; }
  std::optional<OpacityTile> const& tile() const { return tile_; }

  double open_fraction() const;
  double hole() const { return hole_; }  // the size of a typical hole, m
  double web() const { return web_; }

  // Made at the first call, of a large raster in a few seconds.
  ScreenTransmittance const& transmittance() const;

 private:
  Sheet sheet_;
  std::optional<HolePattern> pattern_;
  std::optional<OpacityTile> tile_;
  double hole_ = 0.0;
  double web_ = 0.0;
  struct Lazy;
  std::shared_ptr<Lazy> lazy_;
};

// Where a screen's tile lies on a surface. Axes before `rotation`: u from the outline's second
// vertex to its third, v counter-clockwise from it as seen from outside. (0, 0) of the tile is at
// `origin` along these from the second vertex, and the tile is turned about it by `rotation`,
// radians, counter-clockwise as seen from outside. A surface that is EnergyPlus's has its lower
// left corner and its lower edge there. Seen from inside it is the mirror image, being the same
// sheet.
struct ScreenPlacement {
  double origin_u = 0.0;  // m
  double origin_v = 0.0;
  double rotation = 0.0;
};

}  // namespace gpu_shading
