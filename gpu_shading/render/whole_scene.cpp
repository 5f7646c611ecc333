#include "render/whole_scene.h"

#include <glm/vec4.hpp>
#include <span>

#include "gl/draw.h"
#include "scene/triangulation.h"
#include "shaders/sources.h"

namespace gpu_shading {

void WholeScene::add(std::vector<Vertex>& vertices, SurfaceId id, Polygon const& polygon,
                     glm::dvec3 const& middle) {
  Mesh const mesh = triangulate(polygon);
  for (std::uint32_t const index : mesh.indices) {
    vertices.push_back({glm::vec3(mesh.vertices[index] - middle), id + 1});
  }
}

WholeScene::WholeScene(std::vector<Vertex> const& vertices)
    : program_(gl::Program::link("whole", shaders::whole_vert, shaders::whole_frag)),
      vertices_(gl::Buffer::create()),
      array_(gl::VertexArray::create()) {
  vertices_.set(std::span<Vertex const>(vertices));
  array_.set_vertices(vertices_, sizeof(Vertex));
  array_.add_floats(gl::VertexArray::Of::vertices, 0, 3, offsetof(Vertex, point));
  array_.add_integers(gl::VertexArray::Of::vertices, 1, 1, offsetof(Vertex, identity));
  gl::set_depth_convention();
}

void WholeScene::begin(gl::Framebuffer const& target, glm::dvec3 const& towards_sun,
                       PictureFrame const& frame, double reach) {
  SunAxes const axes(towards_sun);
  target.bind();
  target.clear_identity();
  target.clear_depth(1.0F);
  gl::blend(gl::Blend::replace);
  gl::write_colour(true);
  gl::no_stencil();
  gl::cut_at_plane(false);
  gl::depth(gl::Test::less, true);
  program_.use();
  program_.set(0, glm::vec4(clip_row(axes.right, frame.low.x, frame.high.x)));
  program_.set(1, glm::vec4(clip_row(axes.up, frame.low.y, frame.high.y)));
  program_.set(2, glm::vec4(glm::dvec4(-0.5 * towards_sun / reach, 0.5)));
  array_.bind();
}

}  // namespace gpu_shading
