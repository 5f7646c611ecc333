#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gl/program.h"
#include "gpu_shading/renderer.h"
#include "render/geometry.h"
#include "render/receiver.h"

namespace gpu_shading {

// Pictures of a receiver in the sun's own view, a parallel projection along the rays.
class Picture {
 public:
  Picture();

  // `casters` are those in view; everything else of the scene is drawn around the receiver, in grey
  // by its luminance where there are `shades`.
  Image draw(Geometry& geometry, Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
             std::span<SurfaceId const> casters, std::vector<Shade> shades,
             glm::dvec3 const& towards_sun, int size);

 private:
  gl::Program tilt_;
  gl::Program plain_;
};

}  // namespace gpu_shading
