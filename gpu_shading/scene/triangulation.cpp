#include "scene/triangulation.h"

#include <GL/glu.h>
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "gpu_shading/error.h"
#include "scene/ring.h"

namespace gpu_shading {
namespace {

// Turns left all the way round, and goes round once.
bool is_convex(Ring const& ring, glm::dvec3 const& up) {
  double turned = 0.0;
  std::size_t const n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    glm::dvec3 const in = glm::normalize(ring[(i + 1) % n] - ring[i]);
    glm::dvec3 const out = glm::normalize(ring[(i + 2) % n] - ring[(i + 1) % n]);
    double const sine = glm::dot(up, glm::cross(in, out));
    constexpr double straight = -1e-9;
    if (sine < straight) return false;
    turned += std::atan2(sine, glm::dot(in, out));
  }
  return turned < 3.0 * std::numbers::pi;
}

Mesh fan(Ring const& ring) {
  Mesh mesh{ring, {}};
  mesh.indices.reserve(3 * (ring.size() - 2));
  for (std::uint32_t i = 1; i + 1 < ring.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, i, i + 1});
  }
  return mesh;
}

// What the tessellator's callbacks write to. C callbacks: nothing may be thrown through GLU, so an
// allocation failure ends the program there.
struct Tessellation {
  Mesh mesh;
  std::deque<std::uint32_t> handles;  // stable addresses for GLU to hand back
  GLenum error = 0;

  std::uint32_t* add(glm::dvec3 const& vertex) {
    handles.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(vertex);
    return &handles.back();
  }
};

void GLAPIENTRY on_vertex(void* vertex, void* state) noexcept {
  static_cast<Tessellation*>(state)->mesh.indices.push_back(*static_cast<std::uint32_t*>(vertex));
}

// Registered so that GLU gives plain triangles, neither strips nor fans.
void GLAPIENTRY on_edge_flag(GLboolean /*boundary*/, void* /*state*/) noexcept {}

void GLAPIENTRY on_combine(GLdouble* place, void** /*of*/, GLfloat* /*weights*/, void** made,
                           void* state) noexcept {
  *made = static_cast<Tessellation*>(state)->add({place[0], place[1], place[2]});
}

void GLAPIENTRY on_error(GLenum error, void* state) noexcept {
  static_cast<Tessellation*>(state)->error = error;
}

template <typename Function>
void set_callback(GLUtesselator* glu, GLenum which, Function* function) {
  gluTessCallback(glu, which, reinterpret_cast<_GLUfuncptr>(function));
}

void add_contour(GLUtesselator* glu, Tessellation& result, Ring const& ring,
                 glm::dvec3 const& origin) {
  gluTessBeginContour(glu);
  for (glm::dvec3 const& vertex : ring) {
    glm::dvec3 local = vertex - origin;
    gluTessVertex(glu, &local.x, result.add(local));
  }
  gluTessEndContour(glu);
}

Mesh tessellate(Ring const& outline, std::vector<Ring> const& holes, glm::dvec3 const& up) {
  std::unique_ptr<GLUtesselator, void (*)(GLUtesselator*)> const glu(gluNewTess(), gluDeleteTess);
  if (!glu) throw Error("cannot create the polygon tessellator (gluNewTess): out of memory");
  Tessellation result;
  set_callback(glu.get(), GLU_TESS_VERTEX_DATA, on_vertex);
  set_callback(glu.get(), GLU_TESS_EDGE_FLAG_DATA, on_edge_flag);
  set_callback(glu.get(), GLU_TESS_COMBINE_DATA, on_combine);
  set_callback(glu.get(), GLU_TESS_ERROR_DATA, on_error);
  gluTessProperty(glu.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
  gluTessNormal(glu.get(), up.x, up.y, up.z);

  // GLU works relative to the polygon: it refuses large coordinates and merges at its own
  // tolerance.
  glm::dvec3 const origin = outline.front();
  gluTessBeginPolygon(glu.get(), &result);
  add_contour(glu.get(), result, outline, origin);
  for (Ring const& hole : holes) {
    Ring const ring = without_repeats(hole);
    if (ring.size() >= 3) add_contour(glu.get(), result, ring, origin);
  }
  gluTessEndPolygon(glu.get());
  if (result.error != 0) {
    throw Error(fmt::format("cannot triangulate a polygon of {} vertices and {} holes: {}",
                            outline.size(), holes.size(),
                            reinterpret_cast<char const*>(gluErrorString(result.error))));
  }
  for (glm::dvec3& vertex : result.mesh.vertices) vertex += origin;
  return std::move(result.mesh);
}

// The two as one piece, if they share an edge, lie in one plane, and turn left all the way round.
std::optional<glm::uvec4> joined(Mesh const& mesh, glm::uvec3 const& a, glm::uvec3 const& b) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (a[i] != b[(j + 1) % 3] || a[(i + 1) % 3] != b[j]) continue;
      glm::uvec4 const corners(a[(i + 1) % 3], a[(i + 2) % 3], a[i], b[(j + 2) % 3]);
      Ring ring;
      for (int k = 0; k < 4; ++k) ring.push_back(mesh.vertices[corners[k]]);
      glm::dvec3 const vector = newell(ring);
      double const size = glm::length(vector);
      if (size == 0.0) return std::nullopt;
      glm::dvec3 const up = vector / size;
      constexpr double flat = 1e-9;
      for (glm::dvec3 const& corner : ring) {
        if (std::abs(glm::dot(corner - ring[0], up)) > flat) return std::nullopt;
      }
      if (!is_convex(ring, up)) return std::nullopt;
      return corners;
    }
  }
  return std::nullopt;
}

}  // namespace

Mesh triangulate(Polygon const& polygon) {
  Ring const outline = without_repeats(polygon.outline);
  if (outline.size() < 3) return {};
  glm::dvec3 const vector = newell(outline);
  if (is_degenerate(outline, vector)) return {};
  glm::dvec3 const up = glm::normalize(vector);
  if (polygon.holes.empty() && is_convex(outline, up)) return fan(outline);
  return tessellate(outline, polygon.holes, up);
}

std::vector<Mesh> triangulate_all(Scene const& scene) {
  std::vector<Mesh> meshes;
  meshes.reserve(scene.size());
  std::size_t vertices = 0;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    meshes.push_back(triangulate(scene[id].polygon));
    vertices += meshes.back().vertices.size();
    if (vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw Error("the scene has more vertices than can be numbered with 32 bits");
    }
  }
  return meshes;
}

std::vector<glm::uvec4> convex_pieces(Mesh const& mesh) {
  std::vector<glm::uvec4> pieces;
  auto const triangle = [&](std::size_t i) {
    return glm::uvec3(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    glm::uvec3 const here = triangle(i);
    if (i + 3 < mesh.indices.size()) {
      if (auto const both = joined(mesh, here, triangle(i + 3))) {
        pieces.push_back(*both);
        i += 3;
        continue;
      }
    }
    pieces.emplace_back(here, here.z);
  }
  return pieces;
}

}  // namespace gpu_shading
