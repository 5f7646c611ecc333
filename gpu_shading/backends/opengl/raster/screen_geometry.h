#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/program.h"
#include "backends/opengl/gl/texture.h"
#include "backends/opengl/gl/vertex_array.h"
#include "backends/opengl/raster/draw_list.h"
#include "filters/perforation/screens.h"

namespace gpu_shading {

// The scene's screens on the device: their quadrilaterals, their textures, and the passes that draw
// them.
class ScreenGeometry {
 public:
  // `views`: records of the views. It and the screens must outlive this object. Throws DeviceError
  // if the device cannot draw screens.
  ScreenGeometry(Screens const& screens, glm::dvec3 const& scene_origin, gl::Buffer const& views);

  std::size_t count() const { return texture_of_.size(); }

  // Adds screens, by index, as draws of one view of a list with the tables of its direction.
  // `pixel_area`: m2 normal to the beam.
  Range add_to(DrawList& list, DirectionTables& tables, std::uint32_t view,
               std::span<int const> numbers, double pixel_area) const;

  // Sets the data of the screens in view at the list's directions.
  SheetBlocks sheets(DrawList const& list, Transmission const& transmission) const;

  void upload(DrawList const& list);

  // Outputs 0 and the factor on the luminance, as in transmit.frag.
  void draw(Range draws) const;
  void draw_all() const { draw({0, draws_.size()}); }

 private:
  void add_quadrilaterals(glm::dvec3 const& scene_origin);
  void add_looks();
  void link_program(int program);

  std::vector<std::uint32_t> indices_;
  std::vector<Range> ranges_;  // of the indices, by screen
  ScreenLook look_of(int number, bool by_effect) const;

  Screens const& screens_;
  int max_texels_ = 0;           // a side of a texture
  std::vector<int> texture_of_;  // by screen; -1: none
  std::vector<gl::ValueTexture> textures_;
  std::vector<ScreenDraw> draws_;        // as uploaded
  std::array<gl::Program, 3> programs_;  // by ScreenLook::program
  gl::Buffer vertices_;
  gl::Buffer draw_indices_;
  gl::StorageBuffer sheets_;
  gl::StorageBuffer regions_;
  gl::VertexArray quadrilaterals_;
};

}  // namespace gpu_shading
