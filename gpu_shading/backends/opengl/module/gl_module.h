#pragma once

#include "backends/interface/device_module.h"

namespace gpu_shading {

// Loads libgpu_shading_gl.so, once: all that needs OpenGL, EGL and libepoxy is in it, so that the
// rest runs where these are missing. Both are of one build. It lies beside this program or library,
// or where the dynamic linker looks. Throws DeviceError if it or something that it needs is
// missing.
DeviceModule const& gl_module();

}  // namespace gpu_shading
