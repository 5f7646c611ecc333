#include "filters/bodies.h"

namespace gpu_shading {

bool BodiesInView::all_or_nothing(View const& pixels) const {
  return gpu_shading::all_or_nothing(screens, pixels);
}

void BodiesInView::shade(LuminanceTile& shaded, PixelMask& lit, View const& pixels) const {
  shade_by_screens(shaded, lit, pixels, screens);
}

}  // namespace gpu_shading
