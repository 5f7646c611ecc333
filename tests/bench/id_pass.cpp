#include "id_pass.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>

#include "gl/check.h"
#include "gl/draw.h"
#include "render/sun_axes.h"
#include "scene/box_tree.h"
#include "scene/casters.h"

namespace gpu_shading {

IdPass::OnDevice::OnDevice(std::vector<WholeScene::Vertex> const& vertices, int side)
    : scene(vertices),
      identities(gl::LayeredTexture::create(gl::Pixel::identity, side, 1)),
      depth(gl::LayeredTexture::create(gl::Pixel::depth, side, 1)),
      target(gl::Framebuffer::of_layers({&identities, &depth})),
      pixels(identities, 0, gl::Readback::Way::when_asked) {}

IdPass::IdPass(Scene const& scene, int side) : side_(side), device_(egl::open_device({})) {
  Box all;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Polygon const& polygon = scene[id].polygon;
    outward_.push_back(area(polygon) * normal(polygon));
    for (glm::dvec3 const& point : polygon.outline) {
      all.include(point);
      points_.push_back(point);
    }
  }
  glm::dvec3 const middle = all.centre();
  for (glm::dvec3& point : points_) point -= middle;
  reach_ = std::max(1.0, glm::distance(all.low, all.high));

  std::vector<WholeScene::Vertex> vertices;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    WholeScene::add(vertices, id, scene[id].polygon, middle);
  }
  vertices_ = vertices.size();
  egl::Current const current = device_.context.make_current();
  on_device_.emplace(vertices, side);
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
  on_device_->scene.begin(on_device_->target, towards_sun, frame, reach_);
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
