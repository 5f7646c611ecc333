#pragma once

#include "backends/interface/device_module.h"
#include "gl_module_name.h"

namespace gpu_shading {

// Loads libgpu_shading_gl.so, once: all that needs OpenGL, EGL and libepoxy is in it, so that the
// rest runs where these are missing. It lies beside this program or library, or where the dynamic
// linker looks. Throws DeviceError if it or something that it needs is missing, or if it was built
// from other headers.
DeviceModule const& gl_module();

}  // namespace gpu_shading

// What the library exports. The macro's name ends in a digest of all headers, so that the function
// of another build, whose classes may differ, is not found.
extern "C" gpu_shading::DeviceModule const* GPU_SHADING_GL_MODULE();
