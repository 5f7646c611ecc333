#include "backends/opengl/module/gl_module.h"
#include "gpu_shading/error.h"

namespace gpu_shading {

DeviceModule const& gl_module() {
  throw DeviceError("no OpenGL: shading is computed on the CPU alone on Windows");
}

}  // namespace gpu_shading
