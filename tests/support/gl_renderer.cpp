#include "support/gl_renderer.h"

#include <memory>
#include <utility>

#include "render/renderer_with_backend.h"
#include "support/shapes.h"

namespace gpu_shading {

Renderer gl_renderer(Scene scene, std::optional<int> resolution, GlSettings const& settings) {
  RendererOptions options;
  options.resolution = resolution;
  options.samples_only = true;
  return RendererWithBackend::make(std::move(scene), options, [&](BackendInput const& input) {
    return std::make_unique<GlBackend>(egl::open(by_opengl).value(), input, settings);
  });
}

}  // namespace gpu_shading
