#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "gpu_shading/scene.h"
#include "render/sun_axes.h"

namespace gpu_shading {

// Surfaces as the sun sees them, for a parallel projection with depth that leaves in each pixel
// which one it shows. On the device: made, used and ended with its context current.
class WholeScene {
 public:
  struct Vertex {
    glm::vec3 point;         // from the middle of them all
    std::uint32_t identity;  // of the surface, counted from 1; 0 is the sky
  };

  // A surface's triangles.
  static void add(std::vector<Vertex>& vertices, SurfaceId id, Polygon const& polygon,
                  glm::dvec3 const& middle);

  explicit WholeScene(std::vector<Vertex> const& vertices);

  // From here on vertices are drawn to the target, which is cleared, `frame` over all of it;
  // `reach` in metres: twice as far as any point is from the middle, or more.
  void begin(gl::Framebuffer const& target, glm::dvec3 const& towards_sun,
             PictureFrame const& frame, double reach);

 private:
  gl::Program program_;
  gl::Buffer vertices_;
  gl::VertexArray array_;
};

}  // namespace gpu_shading
