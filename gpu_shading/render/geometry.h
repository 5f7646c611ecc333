#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "gpu_shading/scene.h"
#include "render/draw_list.h"
#include "render/screen_geometry.h"
#include "scene/screens.h"

namespace gpu_shading {

// The scene's triangles on the device, and the ways of drawing: surfaces through a view, plainly or
// with what they let through, and a receiver on its tile.
class Geometry {
 public:
  Geometry(Scene const& scene, Screens const& screens);

  // Triangles of a surface, to be added to a DrawList. Empty for a degenerate one.
  std::span<std::uint32_t const> triangles(SurfaceId id) const;
  glm::dvec3 const& scene_origin() const { return scene_origin_; }

  ScreenGeometry const& screens() const { return screens_; }

  void upload(DrawList const& list);

  // Each sets program and vertices up; draws follow. The program's vertex stage is slide.vert.
  void use_surfaces(gl::Program const& program) const;
  void use_tiles() const;
  // Surfaces with what they transmit, by the shades of the draw list, and with the keys of their
  // schedules from `first_key` on; -1: none.
  void use_shades(std::int32_t first_key);
  // A receiver in this colour.
  void use_tiles_in(glm::vec4 const& colour);

  void draw_surfaces(std::size_t view, Range indices) const;
  // Sets the program up too.
  void draw_screens(std::size_t view, Range draws) const;
  void draw_tile(Range vertices) const;

  // slide.vert with no colour.
  gl::Program const& surface_program() const { return surface_program_; }

 private:
  void bind_view(std::size_t view) const;

  glm::dvec3 scene_origin_{0.0};
  std::vector<std::uint32_t> indices_;
  std::vector<Range> ranges_;

  gl::Program surface_program_;
  gl::Program tile_program_;
  gl::Program shade_program_;
  gl::Program coloured_tile_program_;
  ScreenGeometry screens_;
  gl::Buffer surface_vertices_;
  gl::Buffer surface_indices_;
  gl::Buffer tile_vertices_;
  gl::Buffer views_;
  gl::Buffer shades_;
  gl::Buffer keys_;
  gl::VertexArray surfaces_;
  gl::VertexArray tiles_;
  std::size_t view_stride_ = 0;
};

}  // namespace gpu_shading
