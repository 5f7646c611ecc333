#pragma once

#include <memory>

#include "gpu_shading/renderer.h"

namespace gpu_shading {

// The answers of a renderer next to what plain pixel counting makes of the same pixels, N x Ap
// (Jones, Greenberg & Pratt 2012): the number of sunlit pixels times the area of one.
class PixelCount {
 public:
  struct Areas {
    double answered = 0.0;  // m2 normal to the beam
    double counted = 0.0;
  };

  PixelCount(Scene scene, RendererOptions const& options);

  // For a receiver without scheduled shades in view.
  Areas areas(SunDirection sun, SurfaceId receiver);

 private:
  std::shared_ptr<double> counted_;
  Renderer renderer_;
};

}  // namespace gpu_shading
