#pragma once

#include <memory>
#include <optional>

#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/opacity_tile.h"
#include "gpu_shading/screen_transmittance.h"

namespace gpu_shading {

struct ImageBounds;

// The plane of the sheet in which the polygon of its surface lies. The outside is the side to which
// the polygon's normal points.
enum class SheetPlane { centre, outside, inside };

// How a screen is drawn.
enum class ScreenDetail {
  automatic,  // holes up to pixels of 0.7 holes, effective from 1.2, and a blend between
  holes,      // hole by hole, for any size of pixels
  effective,  // by tau(theta, phi)
};

struct Sheet {
  double thickness = 0.0;  // m, 0 allowed
  SheetPlane plane = SheetPlane::centre;
  // Copies of the sheet's holes over its thickness that a ray must pass, front and back included, 1
  // .. 64. Empty: as many as needed. A pattern needs none: a ray passes if it is in the same hole
  // at both faces, which is exact for convex holes. A raster takes as many as
  // keep rays from stepping over its web, at most 64.
  std::optional<int> layers = std::nullopt;
  ScreenDetail detail = ScreenDetail::automatic;
};

// A perforated sheet of any extent, repeated over its surfaces. Safe to share between threads.
class PerforatedScreen {
 public:
  PerforatedScreen(HolePattern const& pattern, Sheet const& sheet);
  PerforatedScreen(OpacityTile tile, Sheet const& sheet);

  Sheet const& sheet() const { return sheet_; }
  // Exactly one of them is set.
  std::optional<HolePattern> const& pattern() const { return pattern_; }
  std::optional<OpacityTile> const& tile() const { return tile_; }

  double open_fraction() const;
  double hole() const { return hole_; }  // the size of a typical hole, m
  double web() const { return web_; }

  // Computed at the first call, which takes a few seconds for a large raster.
  ScreenTransmittance const& transmittance() const;

  // Of an image, for the CPU. Computed at the first call.
  ImageBounds const& image_bounds() const;

 private:
  Sheet sheet_;
  std::optional<HolePattern> pattern_;
  std::optional<OpacityTile> tile_;
  double hole_ = 0.0;
  double web_ = 0.0;
  struct Lazy;
  std::shared_ptr<Lazy> lazy_;
};

}  // namespace gpu_shading
