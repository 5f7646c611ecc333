#include "id_pass.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "gl/check.h"
#include "gl/draw.h"
#include "render/sun_axes.h"
#include "scene/casters.h"
#include "scene/triangulation.h"
#include "shaders/sources.h"

namespace gpu_shading {

IdPass::OnDevice::OnDevice(std::vector<Vertex> const& contents, int side)
    : program(gl::Program::link("whole", shaders::whole_vert, shaders::whole_frag)),
      vertices(gl::Buffer::create()),
      array(gl::VertexArray::create()),
      identities(gl::LayeredTexture::create(gl::Pixel::identity, side, 1)),
      depth(gl::LayeredTexture::create(gl::Pixel::depth, side, 1)),
      target(gl::Framebuffer::of_layers({&identities, &depth})),
      pixels(identities, 0, gl::Readback::Way::when_asked) {
  vertices.set(std::span<Vertex const>(contents));
  array.set_vertices(vertices, sizeof(Vertex));
  array.add_floats(gl::VertexArray::Of::vertices, 0, 3, offsetof(Vertex, point));
  array.add_integers(gl::VertexArray::Of::vertices, 1, 1, offsetof(Vertex, identity));
}

IdPass::IdPass(Scene const& scene, int side) : side_(side), device_(egl::open_device({})) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Polygon const& polygon = scene[id].polygon;
    outward_.push_back(area(polygon) * normal(polygon));
    for (glm::dvec3 const& point : polygon.outline) {
      low = glm::min(low, point);
      high = glm::max(high, point);
      points_.push_back(point);
    }
  }
  glm::dvec3 const middle = 0.5 * (low + high);
  for (glm::dvec3& point : points_) point -= middle;
  reach_ = std::max(1.0, glm::distance(low, high));

  std::vector<Vertex> vertices;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Mesh const mesh = triangulate(scene[id].polygon);
    for (std::uint32_t const index : mesh.indices) {
      vertices.push_back({glm::vec3(mesh.vertices[index] - middle), id + 1});
    }
  }
  vertices_ = vertices.size();
  egl::Current const current = device_.context.make_current();
  on_device_.emplace(vertices, side);
  gl::set_depth_convention();
  gl::check("uploading a scene for an id pass");
}

IdPass::~IdPass() {
  egl::Current const current = device_.context.make_current();
  on_device_.reset();
}

std::vector<double> IdPass::sunlit_fractions(SunDirection sun) {
  glm::dvec3 const towards_sun = to_vector(sun);
  SunAxes const axes(towards_sun);
  PictureFrame frame;
  for (glm::dvec3 const& point : points_) frame.include(axes(point));
  glm::dvec2 const pixel = (frame.high - frame.low) / static_cast<double>(side_);

  egl::Current const current = device_.context.make_current();
  gl::Framebuffer const& target = on_device_->target;
  target.bind();
  target.clear_identity();
  target.clear_depth(1.0F);
  gl::blend(gl::Blend::replace);
  gl::write_colour(true);
  gl::no_stencil();
  gl::cut_at_plane(false);
  gl::depth(gl::Test::less, true);
  gl::Program& program = on_device_->program;
  program.use();
  program.set(0, glm::vec4(clip_row(axes.right, frame.low.x, frame.high.x)));
  program.set(1, glm::vec4(clip_row(axes.up, frame.low.y, frame.high.y)));
  program.set(2, glm::vec4(glm::dvec4(-0.5 * towards_sun / reach_, 0.5)));
  on_device_->array.bind();
  gl::draw_vertices(0, vertices_);
  on_device_->pixels.start(1);
  std::vector<std::uint32_t> const counts = count(on_device_->pixels.layer<std::uint32_t>(0));
  gl::check("drawing an id pass");

  std::vector<double> fractions(outward_.size());
  for (std::size_t id = 0; id < fractions.size(); ++id) {
    double const projected = glm::dot(outward_[id], towards_sun);
    if (projected <= edge_on * glm::length(outward_[id])) continue;
    fractions[id] = std::min(1.0, counts[id + 1] * pixel.x * pixel.y / projected);
  }
  return fractions;
}

std::vector<std::uint32_t> IdPass::count(std::span<std::uint32_t const> pixels) const {
  using Counts = std::vector<std::uint32_t>;
  tbb::enumerable_thread_specific<Counts> parts(Counts(outward_.size() + 1));
  auto const width = static_cast<std::size_t>(side_);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, width), [&](auto const& rows) {
    Counts& counts = parts.local();
    auto const mine = pixels.subspan(rows.begin() * width, rows.size() * width);
    // A run of pixels at a time: most have their neighbour's surface.
    for (auto at = mine.begin(); at != mine.end();) {
      auto const end = std::find_if(at, mine.end(), [&](auto other) { return other != *at; });
      counts[*at] += static_cast<std::uint32_t>(end - at);
      at = end;
    }
  });
  Counts sum(outward_.size() + 1);
  for (Counts const& part : parts) {
    std::transform(part.begin(), part.end(), sum.begin(), sum.begin(), std::plus());
  }
  return sum;
}

}  // namespace gpu_shading
