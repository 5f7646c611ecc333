#pragma once

#include <span>

#include "filters/crown/crowns.h"
#include "filters/perforation/screen_shading.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"
#include "view/view.h"

namespace gpu_shading {

// The casters in front of a receiver that are not flat, at one sun direction, by kind.
struct BodiesInView {
  ScreensInView screens = {};
  std::span<CrownInBeam const> crowns = {};

  bool empty() const { return screens.numbers.empty() && crowns.empty(); }
  // Whether they let the beam pass or not, and nothing between.
  bool all_or_nothing(View const& pixels) const;
  // Multiplies the luminance of a tile's sunlit pixels by their transmittance, on the CPU, and
  // darkens those that nothing reaches; only this if the tile is laid out without luminance, which
  // it may be if they are all_or_nothing. `pixels` is the view of the casters in front, with x and
  // y in pixels. The luminance of other pixels is undefined afterwards.
  void shade(LuminanceTile& shaded, PixelMask& lit, View const& pixels) const;
};

}  // namespace gpu_shading
