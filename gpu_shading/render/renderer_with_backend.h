#pragma once

#include <functional>
#include <memory>

#include "backends/interface/view_backend.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// Makes a renderer whose views another back end answers than the device of its options. The back
// end is opened once, with an input that lives as long as the renderer.
class RendererWithBackend {
 public:
  using Open = std::function<std::unique_ptr<ViewBackend>(BackendInput const& input)>;

  static Renderer make(Scene scene, RendererOptions options, Open const& open);
};

}  // namespace gpu_shading
