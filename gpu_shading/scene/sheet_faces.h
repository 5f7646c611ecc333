#pragma once

#include "gpu_shading/scene.h"

namespace gpu_shading {

// The positions of the faces of a surface's sheet in metres along its normal; both 0 without a
// screen.
struct SheetFaces {
  double inside = 0.0;
  double outside = 0.0;
};
SheetFaces sheet_faces(Surface const& surface);

}  // namespace gpu_shading
