#pragma once

#include <glm/vec4.hpp>
#include <span>

#include "render/luminance_tile.h"
#include "render/pixel_mask.h"
#include "render/screen_view.h"
#include "render/view.h"
#include "scene/screens.h"

namespace gpu_shading {

// Screens in front of a receiver at one direction of the sun.
struct ScreensInView {
  Screens const* screens = nullptr;
  ScreenView const* seen = nullptr;
  std::span<int const> numbers;
};

// Multiplies the luminance of a tile's lit pixels by what screens let through, on the CPU: what
// screen.vert and screen.geom do on a device, and SheetRays what screen.frag does. `pixels` is the
// view of what is in front, its x and y in pixels. Of pixels that are not lit the luminance may
// become anything.
void shade_by_screens(LuminanceTile& shaded, PixelMask const& lit, View const& pixels,
                      ScreensInView const& in_view);

}  // namespace gpu_shading
