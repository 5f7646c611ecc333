#include "render/geometry.h"

#include <cstddef>
#include <cstring>
#include <limits>

#include "gl/check.h"
#include "gl/draw.h"
#include "gl/limits.h"
#include "gpu_shading/error.h"
#include "render/twice_float.h"
#include "scene/triangulation.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

struct Vertex {
  TwiceFloat place;
  SurfaceId surface;
};
static_assert(sizeof(Vertex) == sizeof(TwiceFloat) + sizeof(SurfaceId));

// Any point near the model will do: the halves of TwiceFloat take care of the rest.
glm::dvec3 some_point(Scene const& scene) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (!scene[id].polygon.outline.empty()) return scene[id].polygon.outline.front();
  }
  return glm::dvec3(0.0);
}

}  // namespace

Geometry::Geometry(Scene const& scene, Screens const& screens)
    : scene_origin_(some_point(scene)), screens_(screens, scene_origin_) {
  std::vector<Vertex> vertices;
  ranges_.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Mesh const mesh = triangulate(scene[id].polygon);
    if (vertices.size() + mesh.vertices.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw Error("the scene has more vertices than can be numbered with 32 bits");
    }
    auto const base = static_cast<std::uint32_t>(vertices.size());
    ranges_.push_back({indices_.size(), mesh.indices.size()});
    for (std::uint32_t const index : mesh.indices) indices_.push_back(base + index);
    for (glm::dvec3 const& vertex : mesh.vertices) {
      vertices.push_back({TwiceFloat(vertex - scene_origin_), id});
    }
  }

  surface_program_ = gl::Program::link("surfaces", shaders::slide_vert, shaders::nothing_frag);
  tile_program_ = gl::Program::link("tiles", shaders::tile_vert, shaders::nothing_frag);

  // Opaque scenes need none of it.
  constexpr int shade_blocks = 2;
  if (gl::query_limits().vertex_storage_blocks >= shade_blocks) {
    shade_program_ = gl::Program::link("shades", shaders::transmit_vert, shaders::transmit_frag);
  }
  coloured_tile_program_ =
      gl::Program::link("coloured tiles", shaders::tile_vert, shaders::plain_frag);

  surface_vertices_ = gl::Buffer::create();
  surface_vertices_.set(std::span<Vertex const>(vertices));
  surface_indices_ = gl::Buffer::create();
  tile_vertices_ = gl::Buffer::create();
  views_ = gl::Buffer::create();
  shades_ = gl::Buffer::create();
  keys_ = gl::Buffer::create();

  surfaces_ = gl::VertexArray::create();
  surfaces_.set_vertices(surface_vertices_, sizeof(Vertex));
  surfaces_.add_attribute(0, 3, offsetof(TwiceFloat, high));
  surfaces_.add_attribute(1, 3, offsetof(TwiceFloat, low));
  surfaces_.add_identity(2, offsetof(Vertex, surface));
  surfaces_.set_indices(surface_indices_);
  tiles_ = gl::VertexArray::create();
  tiles_.set_vertices(tile_vertices_, sizeof(glm::vec2));
  tiles_.add_attribute(0, 2, 0);

  auto const alignment = static_cast<std::size_t>(gl::query_limits().uniform_offset_alignment);
  view_stride_ = (sizeof(ViewBlock) + alignment - 1) / alignment * alignment;
  gl::set_depth_convention();
  gl::check("uploading the scene");
}

std::span<std::uint32_t const> Geometry::triangles(SurfaceId id) const {
  Range const range = ranges_.at(id);
  return {indices_.data() + range.first, range.count};
}

void Geometry::upload(DrawList const& list) {
  surface_indices_.set(list.indices());
  tile_vertices_.set(list.tile_vertices());
  std::vector<std::byte> blocks(view_stride_ * list.views().size());
  for (std::size_t i = 0; i < list.views().size(); ++i) {
    std::memcpy(blocks.data() + i * view_stride_, &list.views()[i], sizeof(ViewBlock));
  }
  views_.set(std::span<std::byte const>(blocks));
  screens_.upload(list);
  if (list.shades().empty()) return;
  shades_.set(list.shades());
  // A block without storage is an error even where no one reads it.
  glm::vec4 const none(0.0F);
  keys_.set(list.keys().empty() ? std::span(&none, 1) : list.keys());
}

void Geometry::use_surfaces(gl::Program const& program) const {
  program.use();
  surfaces_.bind();
}

void Geometry::use_tiles() const {
  tile_program_.use();
  tiles_.bind();
}

void Geometry::use_shades(std::int32_t first_key) {
  constexpr std::uint32_t shades_binding = 0;
  constexpr std::uint32_t keys_binding = 1;
  if (shade_program_.empty()) {
    throw DeviceError(
        "the device has no storage buffers in its vertex stage, which transparent shades need; "
        "choose another (gpu_shading devices), or software");
  }
  shade_program_.set(0, first_key);
  shade_program_.use();
  surfaces_.bind();
  shades_.bind_storage(shades_binding);
  keys_.bind_storage(keys_binding);
}

void Geometry::use_tiles_in(glm::vec4 const& colour) {
  coloured_tile_program_.set(0, colour);
  coloured_tile_program_.use();
  tiles_.bind();
}

void Geometry::bind_view(std::size_t view) const {
  constexpr std::uint32_t view_binding = 0;
  views_.bind_uniform(view_binding, view * view_stride_, sizeof(ViewBlock));
}

void Geometry::draw_screens(std::size_t view, Range draws) const {
  if (draws.count == 0) return;
  bind_view(view);
  screens_.draw(draws);
}

void Geometry::draw_surfaces(std::size_t view, Range indices) const {
  bind_view(view);
  gl::draw_indexed(indices.first, indices.count);
}

void Geometry::draw_tile(Range vertices) const {
  gl::draw_vertices(vertices.first, vertices.count);
}

}  // namespace gpu_shading
