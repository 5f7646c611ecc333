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
// no ray steps over a web, `most` at most; 0 past the longest way through a hole, where the sheet
// is solid. `web` above 0, shifts from 0. Round, square and hexagonal holes of 64 texels, drawn so,
// are within 2e-3 of the closed form over theta 0 .. 85 degrees, on average 7e-4.
int layers_for(double shift, double web, double longest_chord, int most = 64);

// Share of the beam that `layers` equidistant copies of the tile over the thickness let pass, at
// four rays for each texel: what a renderer of layers draws at twice the tile's resolution. No
// layers: 0.
double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi);

// tau(theta, phi) of a sheet as a table of 120 directions phi over pi, equal steps of the shift in
// each, linear between them.
//
// From a pattern: the closed form at 512 steps, within 1e-3 of it, 1e-5 for round holes; squares
// end at different shifts from one phi to the next. From a tile: layers a texel apart or more (but
// half a web at most, and a 128th of the tile's shorter side), added one after the other until
// nothing passes, which gives all angles theta of a phi together. With holes of 48 texels that is
// within 4e-3 of the closed form, on average 1e-3, and takes half a second; in general 480 x steps
// x texels interpolations of 1 to 2 ns. A way through the tile that
// does not end (slats) is followed for eight widths and heights of it, and lets as much pass
// farther; near such a direction the table is coarse.
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

  // The shift from which nothing passes in any direction phi, within a step; infinite where a way
  // does not end.
  double longest_chord() const { return longest_chord_; }
  // tan(theta) = longest chord / thickness.
  double cut_off() const;

  // The table as a texture: directions() rows, phi from 0 in steps of pi / directions(), which
  // repeat, and steps() columns, the shift from 0 in steps of step().
  static constexpr int directions() { return 120; }
  int steps() const { return steps_; }
  double step() const { return step_; }
  std::span<float const> values() const { return values_; }

 private:
  double at(int direction, double shift) const;

  double thickness_ = 0.0;
  double step_ = 0.0;
  int steps_ = 0;
  double longest_chord_ = 0.0;
  std::vector<float> values_;
};

// Where in a sheet the polygon of its surface lies. The outside is the side that the polygon's
// normal points to.
enum class SheetPlane { centre, outside, inside };

// How a screen is drawn.
enum class ScreenDetail {
  automatic,  // holes where pixels are small beside them, else effective; between, a blend
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

  // Made at the first call, of a raster in a second or so.
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
