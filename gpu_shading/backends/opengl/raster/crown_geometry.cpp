#include "backends/opengl/raster/crown_geometry.h"

#include <array>
#include <glm/geometric.hpp>
#include <numeric>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/limits.h"
#include "backends/opengl/raster/split_double.h"
#include "gpu_shading/error.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

struct BoxVertex {
  SplitDouble position;
  glm::vec3 corner;
  std::array<glm::vec3, 3> to_cube;  // by rows
  glm::vec3 solid;
  glm::vec3 facing;
  std::int32_t surface;
};
static_assert(sizeof(BoxVertex) ==
              sizeof(SplitDouble) + 6 * sizeof(glm::vec3) + sizeof(std::int32_t));

// In a cube of the world's axes.
void add_mesh(Crowns::Entry const& crown, glm::dvec3 const& scene_origin,
              std::vector<BoxVertex>& vertices) {
  double const reach = crown.reach();
  auto const scale = static_cast<float>(1.0 / reach);
  for (CrownMesh::Triangle const& face : crown.faces()) {
    for (glm::dvec3 const& corner : face) {
      vertices.push_back({SplitDouble(corner - scene_origin),
                          glm::vec3((corner - crown.centre) / reach),
                          {{{scale, 0.0F, 0.0F}, {0.0F, scale, 0.0F}, {0.0F, 0.0F, scale}}},
                          glm::vec3(0.0F),
                          glm::vec3(0.0F),
                          static_cast<std::int32_t>(crown.surface)});
    }
  }
}

// The corners of each face in order, as Crowns::Entry numbers them.
void add_box(Crowns::Entry const& crown, glm::dvec3 const& scene_origin,
             std::vector<BoxVertex>& vertices) {
  auto const corners = crown.corners();
  std::array<glm::vec3, 3> to_cube{};
  for (std::size_t axis = 0; axis < to_cube.size(); ++axis) {
    glm::dvec3 const& half = crown.half.at(axis);
    to_cube.at(axis) = glm::vec3(half / glm::dot(half, half));
  }
  glm::vec3 const solid(crown.solid.square, crown.solid.linear, crown.solid.constant);
  for (unsigned axis = 0; axis < 3; ++axis) {
    unsigned const a = 1U << (axis + 1) % 3;
    unsigned const b = 1U << (axis + 2) % 3;
    for (unsigned const fixed : {0U, 1U << axis}) {
      glm::vec3 facing(0.0F);
      facing[static_cast<int>(axis)] = fixed == 0 ? -1.0F : 1.0F;
      for (unsigned const number :
           {fixed, fixed | a, fixed | a | b, fixed, fixed | a | b, fixed | b}) {
        auto const side = [&](unsigned of) { return (number >> of & 1U) != 0 ? 1.0F : -1.0F; };
        vertices.push_back({SplitDouble(corners.at(number) - scene_origin),
                            {side(0), side(1), side(2)},
                            to_cube,
                            solid,
                            facing,
                            static_cast<std::int32_t>(crown.surface)});
      }
    }
  }
}

}  // namespace

CrownGeometry::CrownGeometry(Crowns const& crowns, glm::dvec3 const& scene_origin,
                             gl::Buffer const& views)
    : crowns_(crowns) {
  if (crowns_.entries().empty()) return;
  gl::require_vertex_storage("crowns of trees");
  program_ = gl::Program::link("crowns", shaders::crown_vert, shaders::crown_frag);
  std::vector<BoxVertex> vertices;
  for (Crowns::Entry const& crown : crowns_.entries()) {
    first_vertex_.push_back(static_cast<std::uint32_t>(vertices.size()));
    (crown.crown.mesh ? add_mesh : add_box)(crown, scene_origin, vertices);
  }
  first_vertex_.push_back(static_cast<std::uint32_t>(vertices.size()));
  vertices_ = gl::Buffer::create();
  vertices_.set(std::span<BoxVertex const>(vertices));
  draw_indices_ = gl::Buffer::create();
  commands_ = gl::Buffer::create();
  boxes_ = gl::VertexArray::create();
  boxes_.set_vertices(vertices_, sizeof(BoxVertex));
  using Of = gl::VertexArray::Of;
  boxes_.add_floats(Of::vertices, 0, 3, offsetof(SplitDouble, high));
  boxes_.add_floats(Of::vertices, 1, 3, offsetof(SplitDouble, low));
  boxes_.add_floats(Of::vertices, 2, 3, offsetof(BoxVertex, corner));
  boxes_.add_integers(Of::vertices, 3, 1, offsetof(BoxVertex, surface));
  // As in crown.vert, after the view.
  constexpr std::uint32_t to_cube = 11;
  for (std::uint32_t row = 0; row < 3; ++row) {
    boxes_.add_floats(Of::vertices, to_cube + row, 3,
                      offsetof(BoxVertex, to_cube) + row * sizeof(glm::vec3));
  }
  boxes_.add_floats(Of::vertices, to_cube + 3, 3, offsetof(BoxVertex, solid));
  boxes_.add_floats(Of::vertices, to_cube + 4, 3, offsetof(BoxVertex, facing));
  add_view_records(boxes_, views);
  boxes_.set_indices(draw_indices_);
  gl::check("uploading crowns");
}

void CrownGeometry::add_to(DrawList& list, DirectionTables const& tables, std::uint32_t view,
                           std::span<CrownInBeam const> crowns) const {
  std::vector<std::uint32_t> indices;
  for (CrownInBeam const& crown : crowns) {
    list.set_extinction(tables.first_shade + crown.crown->surface, crown.extinction);
    auto const number = static_cast<std::size_t>(crown.crown - crowns_.entries().data());
    std::size_t const known = indices.size();
    indices.resize(known + first_vertex_[number + 1] - first_vertex_[number]);
    std::iota(indices.begin() + static_cast<std::ptrdiff_t>(known), indices.end(),
              first_vertex_[number]);
  }
  list.add_crown_draw(indices, view);
}

void CrownGeometry::upload(DrawList const& list) {
  draws_ = list.crown_draws().size();
  if (draws_ == 0) return;
  draw_indices_.set(list.crown_indices());
  commands_.set(list.crown_draws());
}

void CrownGeometry::draw(gl::StorageBuffer const& shades) const {
  if (draws_ == 0) return;
  constexpr std::uint32_t shades_binding = 0;
  gl::cut_at_plane(false);
  program_.use();
  boxes_.bind();
  shades.bind(shades_binding);
  gl::draw_commands(commands_, 0, draws_);
}

}  // namespace gpu_shading
