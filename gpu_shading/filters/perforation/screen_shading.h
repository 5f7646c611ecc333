#pragma once

#include <cmath>
#include <span>

#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"
#include "view/view.h"

namespace gpu_shading {

// Screens in front of a receiver at one sun direction.
struct ScreensInView {
  Screens const* screens = nullptr;
  std::span<SheetInBeam const> sheets;  // by number
  std::span<int const> numbers;         // of screens in view
  // Some ray passes two of them: what it passes depends on how their holes meet.
  bool overlap = false;
  // Holes are drawn for any size of pixels, unless a screen is to be drawn by its effect.
  bool every_hole = false;
  // What is drawn by its effect is drawn by rows of holes (RowProfile).
  bool by_rows = false;
  // So many lattices of pixels together have pixels that are as many times as small.
  int lattices = 1;
};

// The size of pixels in a screen's plane, m, or 0 where holes are drawn for any size.
inline double drawn_pixel(ScreensInView const& in_view, Screens::Entry const& screen,
                          View const& pixels) {
  return in_view.every_hole ? 0.0 : pixel_in_sheet(screen, pixels) / std::sqrt(in_view.lattices);
}

// Whether screens let the beam pass or not, and nothing between.
bool all_or_nothing(ScreensInView const& in_view, View const& pixels);

// Multiplies the luminance of a tile's sunlit pixels by the transmittance of screens, on the CPU,
// and darkens those that nothing reaches; only this if the tile is laid out without luminance,
// which it may be if the screens are all_or_nothing. It does the work of screen.vert and
// screen.geom, and SheetRays that of screen.frag. `pixels` is the view of the casters in front,
// with x and y in pixels. The luminance of other pixels is undefined afterwards.
void shade_by_screens(LuminanceTile& shaded, PixelMask& lit, View const& pixels,
                      ScreensInView const& in_view);

}  // namespace gpu_shading
