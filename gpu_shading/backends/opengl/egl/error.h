#pragma once

#include <string>
#include <string_view>

#include "gpu_shading/error.h"

namespace gpu_shading::egl {

// "FUNCTION failed: EGL_NAME (0xCODE); HINT" for this thread's last EGL error, which it clears.
std::string describe_failure(std::string_view function, std::string_view hint);

}  // namespace gpu_shading::egl
