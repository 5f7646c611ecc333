#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/program.h"
#include "backends/opengl/gl/vertex_array.h"
#include "backends/opengl/raster/draw_list.h"
#include "filters/crown/crowns.h"

namespace gpu_shading {

// The scene's crowns on the device: the faces of their boxes, and the pass that draws them.
class CrownGeometry {
 public:
  // `views`: records of the views. It and the crowns must outlive this object. Throws DeviceError
  // if the device cannot draw crowns.
  CrownGeometry(Crowns const& crowns, glm::dvec3 const& scene_origin, gl::Buffer const& views);

  // Adds crowns as a draw of one view of a list with the tables of its direction.
  void add_to(DrawList& list, DirectionTables const& tables, std::uint32_t view,
              std::span<CrownInBeam const> crowns) const;

  void upload(DrawList const& list);

  // Outputs 0 and the factor on the luminance, as in transmit.frag. `shades`: those of the list.
  void draw(gl::StorageBuffer const& shades) const;

 private:
  Crowns const& crowns_;
  std::vector<std::uint32_t> first_vertex_;  // of each crown, and the end
  std::size_t draws_ = 0;                    // as uploaded
  gl::Program program_;
  gl::Buffer vertices_;
  gl::Buffer draw_indices_;
  gl::Buffer commands_;
  gl::VertexArray boxes_;
};

}  // namespace gpu_shading
