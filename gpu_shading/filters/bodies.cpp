#include "filters/bodies.h"

namespace gpu_shading {

bool BodiesInView::all_or_nothing(View const& pixels) const {
  return crowns.empty() && gpu_shading::all_or_nothing(screens, pixels);
}

void BodiesInView::shade(LuminanceTile& shaded, PixelMask& lit, View const& pixels) const {
  shade_by_screens(shaded, lit, pixels, screens);
  shade_by_crowns(shaded, lit, pixels, crowns);
}

}  // namespace gpu_shading
