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

  // What shades the receiver, and how.
  struct Shading {
    std::vector<SurfaceId> plain;      // casters in view that are more than screens
    std::vector<int> screens_in_view;  // by their numbers
    std::vector<int> all_screens;
    std::vector<Shade> shades;  // empty: all casters in view are opaque
    std::vector<double> deployments;
  };

  // Everything else of the scene is drawn around the receiver, which is grey by its luminance where
  // there are shades.
  Image draw(Geometry& geometry, Scene const& scene, Screens const& screens, SurfaceId receiver,
             PlaneFrame const& frame, Shading const& shading, glm::dvec3 const& towards_sun,
             int size);

 private:
  gl::Program tilt_;
  gl::Program plain_;
};

}  // namespace gpu_shading
