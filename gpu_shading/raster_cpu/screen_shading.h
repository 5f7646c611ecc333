#pragma once

#include <span>

#include "raster_cpu/luminance_tile.h"
#include "scene/screens.h"
#include "view/pixel_mask.h"
#include "view/sheet_in_beam.h"
#include "view/view.h"

namespace gpu_shading {

// Screens in front of a receiver at one sun direction.
struct ScreensInView {
  Screens const* screens = nullptr;
  std::span<SheetInBeam const> sheets;  // by number
  std::span<int const> numbers;         // of screens in view
};

// Multiplies the luminance of a tile's sunlit pixels by the transmittance of screens, on the CPU.
// It does the work of screen.vert and screen.geom, and SheetRays that of screen.frag. `pixels` is
// the view of the casters in front, with x and y in pixels. The luminance of other pixels is
// undefined afterwards.
void shade_by_screens(LuminanceTile& shaded, PixelMask const& lit, View const& pixels,
                      ScreensInView const& in_view);

}  // namespace gpu_shading
