#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gl/program.h"
#include "gpu_shading/renderer.h"
#include "render/geometry.h"
#include "render/receiver.h"
#include "render/transmission.h"

namespace gpu_shading {

// Pictures of a receiver in the sun's own view, a parallel projection along the rays.
class Picture {
 public:
  Picture();

  // What shades the receiver, and how.
  struct Shading {
    std::vector<SurfaceId> casters;  // in view
    std::vector<Shade> shades;       // by surface; empty: all casters in view are opaque
  };

  // Everything else of the scene is drawn around the receiver, which is grey by its luminance where
  // there are shades.
  Image draw(Geometry& geometry, Scene const& scene, Transmission const& transmission,
             SurfaceId receiver, PlaneFrame const& frame, Shading const& shading,
             glm::dvec3 const& towards_sun, int size);

 private:
  gl::Program tilt_;
  gl::Program plain_;
};

}  // namespace gpu_shading
