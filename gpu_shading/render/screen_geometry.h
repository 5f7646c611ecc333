#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "render/draw_list.h"
#include "scene/screens.h"

namespace gpu_shading {

// The scene's screens on the device: their quadrilaterals, the textures of those that have one, and
// the way of drawing them.
class ScreenGeometry {
 public:
  // `views`: records to be drawn by, which must outlive it. Throws DeviceError where the device
  // cannot.
  ScreenGeometry(Screens const& screens, glm::dvec3 const& scene_origin, gl::Buffer const& views);

  // Texels a side of a texture.
  int most_texels() const { return most_texels_; }

  std::size_t count() const { return looks_.size(); }

  // Screens by their numbers as draws of one view of a list, whose tables of the direction these
  // are. `pixel_area`: m2 across the beam.
  Range add_to(DrawList& list, DirectionTables& tables, std::uint32_t view,
               std::span<int const> numbers, double pixel_area) const;

  void upload(DrawList const& list);

  // Gives 0 and what is kept of the luminance, as transmit.frag.
  void draw(Range draws) const;
  void draw_all() const { draw({0, draws_.size()}); }

 private:
  void add_quadrilaterals(Screens const& screens, glm::dvec3 const& scene_origin);
  void add_looks(Screens const& screens);
  void link_program(int program);

  int most_texels_ = 0;
  std::vector<std::uint32_t> indices_;
  std::vector<Range> ranges_;  // of the indices, by screen
  struct Look {
    std::shared_ptr<PerforatedScreen const> screen;
    glm::dvec3 normal{0.0};
    int texture = -1;  // none
  };
  ScreenLook look_of(Look const& look, bool by_effect) const;

  std::vector<Look> looks_;  // by screen
  std::vector<gl::ValueTexture> textures_;
  std::vector<ScreenDraw> draws_;        // as uploaded
  std::array<gl::Program, 3> programs_;  // by ScreenLook::program
  gl::Buffer vertices_;
  gl::Buffer draw_indices_;
  gl::Buffer sheets_;
  gl::Buffer regions_;
  gl::VertexArray quadrilaterals_;
};

}  // namespace gpu_shading
