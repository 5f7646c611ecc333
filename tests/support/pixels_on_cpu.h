#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "backends/cpu/cpu_backend.h"
#include "gpu_shading/renderer.h"
#include "render/renderer_with_backend.h"

namespace gpu_shading {

// The CPU at the centres of pixels, where OpenGL samples.
class PixelsOnCpu : public CpuBackend {
 public:
  using CpuBackend::CpuBackend;
  bool samples_pixels() const override { return true; }
  std::optional<std::size_t> few_casters(bool /*interiors*/) const override { return {}; }
  void add(std::vector<ReceiverView> views) override {
    for (ReceiverView& view : views) view.at_pixels = true;
    CpuBackend::add(std::move(views));
  }
};

inline Renderer counting_pixels(Scene scene, RendererOptions const& options) {
  return RendererWithBackend::make(std::move(scene), options, [](BackendInput const& input) {
    return std::make_unique<PixelsOnCpu>(input);
  });
}

inline Renderer counting_pixels(Scene scene, int resolution) {
  RendererOptions options;
  options.resolution = resolution;
  options.samples_only = true;
  return counting_pixels(std::move(scene), options);
}

}  // namespace gpu_shading
