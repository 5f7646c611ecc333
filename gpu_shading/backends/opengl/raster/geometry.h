#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/program.h"
#include "backends/opengl/gl/vertex_array.h"
#include "backends/opengl/raster/crown_geometry.h"
#include "backends/opengl/raster/draw_list.h"
#include "backends/opengl/raster/screen_geometry.h"
#include "filters/transmission.h"
#include "geometry/triangulation.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// The scene's triangles on the device, a draw list, and the passes that draw it. Each pass sets all
// state it needs except target, depth and blending.
class Geometry {
 public:
  // `meshes`: of all surfaces of the scene, by id.
  Geometry(Scene const& scene, std::span<Mesh const> meshes, Transmission const& transmission);

  // The triangles of a surface, for a DrawList. Empty for a degenerate surface.
  std::span<std::uint32_t const> triangles(SurfaceId id) const;
  glm::dvec3 const& scene_origin() const { return scene_origin_; }

  ScreenGeometry const& screens() const { return screens_; }
  CrownGeometry const& crowns() const { return crowns_; }

  // Earlier draws keep the data that they still read.
  void upload(DrawList const& list);

  // Draws every tile in this colour.
  void draw_tiles(glm::vec4 const& colour);
  // Draws every caster in black.
  void draw_casters() const;
  // Draws every caster with its transmittance and the keys of its schedules.
  void draw_shades() const;
  // Draws every crown of the list.
  void draw_crowns() const { crowns_.draw(shades_); }
  // Draws every surface behind a window as its identity.
  void draw_interiors() const;

  // Draws some surfaces through one view, with a program whose vertex stage is slide.vert.
  void draw_surfaces(gl::Program const& program, Range indices, std::uint32_t view) const;
  void draw_shades(Range indices, std::uint32_t view) const;

 private:
  void use_shades() const;

  glm::dvec3 scene_origin_{0.0};
  std::vector<std::uint32_t> indices_;
  std::vector<Range> ranges_;

  gl::Program caster_program_;
  gl::Program shade_program_;
  gl::Program interior_program_;
  gl::Program tile_program_;
  gl::Buffer surface_vertices_;
  gl::Buffer surface_indices_;
  gl::Buffer tile_vertices_;
  gl::Buffer views_;
  gl::Buffer commands_;
  gl::StorageBuffer shades_;
  gl::StorageBuffer keys_;
  gl::VertexArray surfaces_;
  gl::VertexArray tiles_;
  ScreenGeometry screens_;
  CrownGeometry crowns_;
  // As uploaded.
  std::size_t vertices_of_tiles_ = 0;
  std::size_t caster_draws_ = 0;
  std::size_t interior_draws_ = 0;
};

}  // namespace gpu_shading
