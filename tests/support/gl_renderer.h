#pragma once

#include <optional>

#include "backends/opengl/raster/gl_backend.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// A renderer that draws with OpenGL on the first device, by given settings of its back end.
Renderer gl_renderer(Scene scene, std::optional<int> resolution, GlSettings const& settings);

}  // namespace gpu_shading
