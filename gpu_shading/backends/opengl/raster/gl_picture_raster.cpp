#include "backends/opengl/raster/gl_picture_raster.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/framebuffer.h"
#include "backends/opengl/gl/program.h"
#include "backends/opengl/raster/geometry.h"
#include "gpu_shading/error.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

constexpr glm::vec4 white{1.0F, 1.0F, 1.0F, 1.0F};
constexpr glm::vec4 black{0.0F, 0.0F, 0.0F, 1.0F};

gl::Framebuffer make_target(gl::Format format, PictureGrid const& grid) {
  auto target =
      gl::Framebuffer::create({format, gl::Format::depth_stencil}, grid.width, grid.height);
  target.bind();
  target.clear_depth(1.0F);
  gl::blend(gl::Blend::replace);
  gl::cut_at_plane(false);
  return target;
}

std::vector<float> read_luminance(gl::Framebuffer const& target) {
  constexpr std::size_t channels = 4;
  constexpr float most = 255.0F;
  std::vector<std::uint8_t> const colours = target.read_colour();
  std::vector<float> luminance;
  luminance.reserve(colours.size() / channels);
  for (std::size_t i = 0; i < colours.size(); i += channels) {
    luminance.push_back(static_cast<float>(colours[i]) / most);
  }
  return luminance;
}

Range add_surfaces(DrawList& list, Geometry const& geometry, std::span<SurfaceId const> surfaces) {
  std::size_t const begin = list.begin_surfaces();
  for (SurfaceId const id : surfaces) list.add_triangles(geometry.triangles(id));
  return list.end_surfaces(begin);
}

std::uint32_t add_view(DrawList& list, Geometry const& geometry, PictureGrid const& grid) {
  glm::ivec4 const no_keys(0, -1, 0, 0);
  return list.add_view(grid.view, geometry.scene_origin(), no_keys);
}

}  // namespace

struct GlPictureRaster::OnDevice {
  explicit OnDevice(PictureScene const& scene)
      : geometry(scene.scene, scene.meshes, scene.transmission) {}

  Geometry geometry;
  gl::Program nearest =
      gl::Program::link("nearest surfaces", shaders::nearest_vert, shaders::identity_frag);
  gl::Program plain = gl::Program::link("plain", shaders::slide_vert, shaders::plain_frag);
};

GlPictureRaster::GlPictureRaster(egl::Device device, PictureScene const& scene)
    : device_(std::move(device)), scene_(scene.scene), transmission_(scene.transmission) {
  egl::Current const current = device_.context.make_current();
  on_device_ = std::make_unique<OnDevice>(scene);
}

GlPictureRaster::~GlPictureRaster() {
  try {
    egl::Current const current = device_.context.make_current();
    on_device_.reset();
  } catch (DeviceError const&) {
    // Like GlBackend.
    static_cast<void>(on_device_.release());
  }
}

std::vector<std::uint32_t> GlPictureRaster::nearest(PictureGrid const& grid,
                                                    std::span<SurfaceId const> surfaces) {
  egl::Current const current = device_.context.make_current();
  Geometry& geometry = on_device_->geometry;
  DrawList list;
  std::uint32_t const view = add_view(list, geometry, grid);
  Range const shown = add_surfaces(list, geometry, surfaces);
  geometry.upload(list);
  gl::Framebuffer const target = make_target(gl::Format::identity, grid);
  target.clear_identity();
  gl::depth(gl::Test::less, true);
  geometry.draw_surfaces(on_device_->nearest, shown, view);
  gl::check("drawing a picture's nearest surfaces");
  return target.read_identity();
}

std::vector<float> GlPictureRaster::through_bodies(PictureGrid const& grid,
                                                   glm::dvec3 const& towards_sun,
                                                   std::span<SurfaceId const> surfaces) {
  egl::Current const current = device_.context.make_current();
  Geometry& geometry = on_device_->geometry;
  DrawList list;
  DirectionTables& tables = list.tables(towards_sun, scene_.size());
  std::uint32_t const view = add_view(list, geometry, grid);
  std::vector<int> numbers(geometry.screens().count());
  std::iota(numbers.begin(), numbers.end(), 0);
  Range const screens = geometry.screens().add_to(list, tables, view, numbers, grid.pixel_area());
  list.set_sheets(geometry.screens().sheets(list, transmission_));
  std::vector<SurfaceId> all(scene_.size());
  std::iota(all.begin(), all.end(), SurfaceId{0});
  geometry.crowns().add_to(list, tables, view, transmission_.crowns_among(all, towards_sun));
  Range const behind = add_surfaces(list, geometry, surfaces);
  geometry.upload(list);
  gl::Framebuffer const target = make_target(gl::Format::colour, grid);
  target.clear_colour(white);
  gl::depth(gl::Test::less, true);
  on_device_->plain.set(0, white);
  geometry.draw_surfaces(on_device_->plain, behind, view);
  gl::depth(gl::Test::less, false);
  gl::blend(gl::Blend::multiply);
  geometry.screens().draw(screens);
  geometry.draw_crowns();
  gl::blend(gl::Blend::replace);
  gl::check("drawing a picture's bodies");
  return read_luminance(target);
}

std::vector<float> GlPictureRaster::luminance(PictureGrid const& grid,
                                              ShadedReceiver const& shaded) {
  egl::Current const current = device_.context.make_current();
  Geometry& geometry = on_device_->geometry;
  DrawList list;
  DirectionTables& tables = list.tables(shaded.towards_sun, scene_.size());
  for (std::size_t i = 0; i < shaded.shades.size(); ++i) {
    list.set_shade(tables.first_shade + shaded.casters[i], shaded.shades[i]);
  }
  std::uint32_t const view = add_view(list, geometry, grid);
  Range const plain = add_surfaces(list, geometry, transmission_.flat_among(shaded.casters));
  Range const screens = geometry.screens().add_to(
      list, tables, view, transmission_.screens_among(shaded.casters), grid.pixel_area());
  geometry.crowns().add_to(list, tables, view,
                           transmission_.crowns_among(shaded.casters, shaded.towards_sun));
  list.set_sheets(geometry.screens().sheets(list, transmission_));
  geometry.upload(list);
  gl::Framebuffer const target = make_target(gl::Format::colour, grid);
  target.clear_colour(white);
  gl::no_depth();
  gl::cut_at_plane(true);
  if (shaded.shades.empty()) {
    on_device_->plain.set(0, black);
    geometry.draw_surfaces(on_device_->plain, plain, view);
  } else {
    gl::blend(gl::Blend::multiply);
    if (plain.count > 0) geometry.draw_shades(plain, view);
    geometry.screens().draw(screens);
    geometry.draw_crowns();
    gl::blend(gl::Blend::replace);
  }
  gl::check("drawing a picture's shaded receiver");
  return read_luminance(target);
}

}  // namespace gpu_shading
