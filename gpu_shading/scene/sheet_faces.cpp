#include "scene/sheet_faces.h"

#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {

SheetFaces sheet_faces(Surface const& surface) {
  if (!surface.screen) return {};
  double const thickness = surface.screen->sheet().thickness;
  switch (surface.screen->sheet().plane) {
    case SheetPlane::outside:
      return {-thickness, 0.0};
    case SheetPlane::inside:
      return {0.0, thickness};
    case SheetPlane::centre:
      break;
  }
  return {-thickness / 2.0, thickness / 2.0};
}

}  // namespace gpu_shading
