#include "backends/opengl/raster/geometry.h"

#include <cstddef>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/limits.h"
#include "backends/opengl/raster/draw_list.h"
#include "backends/opengl/raster/split_double.h"
#include "gpu_shading/error.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

struct Vertex {
  SplitDouble position;
  std::int32_t surface;
};
static_assert(sizeof(Vertex) == sizeof(SplitDouble) + sizeof(std::int32_t));

// Any point near the model works: the halves of SplitDouble provide the precision.
glm::dvec3 some_point(Scene const& scene) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (!scene[id].polygon.outline.empty()) return scene[id].polygon.outline.front();
  }
  return glm::dvec3(0.0);
}

}  // namespace

Geometry::Geometry(Scene const& scene, std::span<Mesh const> meshes,
                   Transmission const& transmission)
    : scene_origin_(some_point(scene)),
      views_(gl::Buffer::create()),
      screens_(transmission.screens(), scene_origin_, views_),
      crowns_(transmission.crowns(), scene_origin_, views_) {
  std::vector<Vertex> vertices;
  ranges_.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Mesh const& mesh = meshes[id];
    auto const base = static_cast<std::uint32_t>(vertices.size());
    ranges_.push_back({indices_.size(), mesh.indices.size()});
    for (std::uint32_t const index : mesh.indices) indices_.push_back(base + index);
    for (glm::dvec3 const& vertex : mesh.vertices) {
      vertices.push_back({SplitDouble(vertex - scene_origin_), static_cast<std::int32_t>(id)});
    }
  }

  caster_program_ = gl::Program::link("casters", shaders::slide_vert, shaders::plain_frag);
  caster_program_.set(0, glm::vec4(0.0F));
  interior_program_ = gl::Program::link("interiors", shaders::slide_vert, shaders::identity_frag);
  tile_program_ = gl::Program::link("tiles", shaders::tile_vert, shaders::plain_frag);
  // Opaque scenes do not need this.
  constexpr int shade_blocks = 2;
  if (gl::query_limits().vertex_storage_blocks >= shade_blocks) {
    shade_program_ = gl::Program::link("shades", shaders::transmit_vert, shaders::transmit_frag);
  }

  surface_vertices_ = gl::Buffer::create();
  surface_vertices_.set(std::span<Vertex const>(vertices));
  surface_indices_ = gl::Buffer::create();
  tile_vertices_ = gl::Buffer::create();
  commands_ = gl::Buffer::create();

  using Of = gl::VertexArray::Of;
  surfaces_ = gl::VertexArray::create();
  surfaces_.set_vertices(surface_vertices_, sizeof(Vertex));
  surfaces_.add_floats(Of::vertices, 0, 3, offsetof(SplitDouble, high));
  surfaces_.add_floats(Of::vertices, 1, 3, offsetof(SplitDouble, low));
  surfaces_.add_integers(Of::vertices, 2, 1, offsetof(Vertex, surface));
  add_view_records(surfaces_, views_);
  surfaces_.set_indices(surface_indices_);
  tiles_ = gl::VertexArray::create();
  tiles_.set_vertices(tile_vertices_, sizeof(TileVertex));
  tiles_.add_floats(Of::vertices, 0, 2, offsetof(TileVertex, place));
  tiles_.add_integers(Of::vertices, 1, 1, offsetof(TileVertex, layer));

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
  views_.set(list.views());
  vertices_of_tiles_ = list.tile_vertices().size();
  caster_draws_ = list.caster_draws().size();
  interior_draws_ = list.interior_draws().size();
  std::vector<gl::Command> commands(list.caster_draws().begin(), list.caster_draws().end());
  commands.insert(commands.end(), list.interior_draws().begin(), list.interior_draws().end());
  commands_.set(std::span<gl::Command const>(commands));
  screens_.upload(list);
  crowns_.upload(list);
  if (list.shades().empty()) return;
  gl::require_storage(list.shades().size_bytes(), "shades");
  gl::require_storage(list.keys().size_bytes(), "keys of schedules");
  shades_.set(list.shades());
  // A storage block without a buffer is an error even if no shader reads it.
  glm::vec4 const none(0.0F);
  keys_.set(list.keys().empty() ? std::span(&none, 1) : list.keys());
}

void Geometry::draw_tiles(glm::vec4 const& colour) {
  gl::cut_at_plane(false);
  tile_program_.set(0, colour);
  tile_program_.use();
  tiles_.bind();
  gl::draw_vertices(0, vertices_of_tiles_);
}

void Geometry::draw_casters() const {
  gl::cut_at_plane(true);
  caster_program_.use();
  surfaces_.bind();
  gl::draw_commands(commands_, 0, caster_draws_);
}

void Geometry::draw_shades() const {
  if (caster_draws_ > 0) {
    use_shades();
    gl::draw_commands(commands_, 0, caster_draws_);
  }
  gl::cut_at_plane(true);
  screens_.draw_all();
  draw_crowns();
}

void Geometry::draw_interiors() const {
  gl::cut_at_plane(true);
  interior_program_.use();
  surfaces_.bind();
  gl::draw_commands(commands_, caster_draws_, interior_draws_);
}

void Geometry::draw_surfaces(gl::Program const& program, Range indices, std::uint32_t view) const {
  program.use();
  surfaces_.bind();
  gl::draw_indexed(indices.first, indices.count, view);
}

void Geometry::draw_shades(Range indices, std::uint32_t view) const {
  use_shades();
  gl::draw_indexed(indices.first, indices.count, view);
}

void Geometry::use_shades() const {
  constexpr std::uint32_t shades_binding = 0;
  constexpr std::uint32_t keys_binding = 1;
  if (shade_program_.empty()) {
    throw DeviceError(
        "the device has no storage buffers in its vertex stage, which transparent shades need; "
        "choose another (gpu_shading devices), or cpu");
  }
  gl::cut_at_plane(true);
  shade_program_.use();
  surfaces_.bind();
  shades_.bind(shades_binding);
  keys_.bind(keys_binding);
}

}  // namespace gpu_shading
