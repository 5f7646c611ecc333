#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "gl/check.h"
#include "gl/draw.h"
#include "gl/framebuffer.h"
#include "render/sun_axes.h"
#include "scene/casters.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

constexpr glm::vec4 white{1.0F, 1.0F, 1.0F, 1.0F};
constexpr glm::vec4 black{0.0F, 0.0F, 0.0F, 1.0F};
constexpr glm::vec4 sky = white;
constexpr glm::vec4 yellow{1.0F, 1.0F, 0.0F, 1.0F};
constexpr glm::vec4 blue{0.0F, 0.0F, 1.0F, 1.0F};

// Around the receiver, as a share of its longer side in the picture.
constexpr double border = 0.15;

int side(double length, double longest, int size) {
  return std::clamp(static_cast<int>(std::lround(size * length / longest)), 1, size);
}

// How far the scene reaches from the origin, for the depth range along the rays.
double reach_of(Scene const& scene, glm::dvec3 const& origin) {
  double reach = 1.0;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    for (glm::dvec3 const& vertex : scene[id].polygon.outline) {
      reach = std::max(reach, glm::distance(vertex, origin));
    }
  }
  return reach;
}

Image from_rows_below(std::vector<std::uint8_t> const& rgba, int width, int height) {
  Image image{width, height, 3, {}};
  auto const columns = static_cast<std::size_t>(width);
  image.pixels.reserve(3 * columns * static_cast<std::size_t>(height));
  for (int y = height - 1; y >= 0; --y) {
    for (std::size_t x = 0; x < columns; ++x) {
      auto const at = rgba.begin() +
                      static_cast<std::ptrdiff_t>(4 * (static_cast<std::size_t>(y) * columns + x));
      image.pixels.insert(image.pixels.end(), at, at + 3);
    }
  }
  return image;
}

}  // namespace

Picture::Picture()
    : tilt_(gl::Program::link("tilt", shaders::slide_vert, shaders::tilt_frag)),
      plain_(gl::Program::link("plain", shaders::slide_vert, shaders::plain_frag)) {}

Image Picture::draw(Geometry& geometry, Scene const& scene, Transmission const& transmission,
                    SurfaceId receiver, PlaneFrame const& frame, Shading const& shading,
                    glm::dvec3 const& towards_sun, int size) {
  SunAxes const axes(towards_sun);
  PictureFrame outline;
  for (glm::dvec3 const& vertex : scene[receiver].polygon.outline) {
    outline.include(axes(vertex - frame.origin));
  }
  PictureFrame const seen = outline.widened(border * outline.longer());
  double const wide = seen.high.x - seen.low.x;
  double const tall = seen.high.y - seen.low.y;
  int const width = side(wide, std::max(wide, tall), size);
  int const height = side(tall, std::max(wide, tall), size);

  View all;
  all.origin = frame.origin;
  all.x = clip_row(axes.right, seen.low.x, seen.high.x);
  all.y = clip_row(axes.up, seen.low.y, seen.high.y);
  all.z = glm::dvec4(-0.5 * towards_sun / reach_of(scene, frame.origin), 0.5);
  View in_front = all;
  in_front.cut = glm::dvec4(frame.normal, -clearance);

  DrawList list;
  DirectionTables& tables = list.tables(towards_sun, scene.size());
  for (SurfaceId id = 0; id < shading.shades.size(); ++id) list.set_shade(id, shading.shades[id]);
  glm::ivec4 const no_keys(0, -1, 0, 0);
  std::uint32_t const whole_view = list.add_view(all, geometry.scene_origin(), no_keys);
  std::uint32_t const front_view = list.add_view(in_front, geometry.scene_origin(), no_keys);
  std::size_t begin = list.begin_surfaces();
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (id != receiver && !scene[id].screen) list.add_triangles(geometry.triangles(id));
  }
  Range const others = list.end_surfaces(begin);
  begin = list.begin_surfaces();
  for (SurfaceId const id : transmission.plain_among(shading.casters)) {
    list.add_triangles(geometry.triangles(id));
  }
  Range const plain = list.end_surfaces(begin);
  double const pixel_area = wide * tall / (static_cast<double>(width) * height);
  std::vector<int> numbers(transmission.screens().entries().size());
  std::iota(numbers.begin(), numbers.end(), 0);
  Range const in_view = geometry.screens().add_to(
      list, tables, front_view, transmission.screens_among(shading.casters), pixel_area);
  Range const all_screens =
      geometry.screens().add_to(list, tables, whole_view, numbers, pixel_area);
  list.set_screen_view(transmission.see(list.directions(), geometry.screens().most_texels()));
  begin = list.begin_surfaces();
  list.add_triangles(geometry.triangles(receiver));
  Range const itself = list.end_surfaces(begin);
  geometry.upload(list);

  auto const target =
      gl::Framebuffer::create({gl::Format::colour, gl::Format::depth_stencil}, width, height);
  target.bind();
  gl::blend(gl::Blend::replace);
  gl::depth(gl::Test::less, true);
  target.clear_colour(sky);
  target.clear_depth(1.0F);
  target.clear_stencil();

  gl::cut_at_plane(false);
  gl::no_stencil();
  tilt_.set(0, glm::vec4(glm::vec3(towards_sun), 0.0F));
  geometry.draw_surfaces(tilt_, others, whole_view);
  // With their holes, over what lies behind them.
  gl::depth(gl::Test::less, false);
  gl::blend(gl::Blend::multiply);
  geometry.screens().draw(all_screens);
  gl::blend(gl::Blend::replace);

  bool const faces_sun = glm::dot(frame.normal, towards_sun) > edge_on;
  gl::no_depth();
  if (!shading.shades.empty()) {
    gl::stencil(gl::Test::always, 1, gl::OnPass::replace);
    plain_.set(0, faces_sun ? white : black);
    geometry.draw_surfaces(plain_, itself, whole_view);
    gl::stencil(gl::Test::equal, 1, gl::OnPass::keep);
    gl::cut_at_plane(true);
    gl::blend(gl::Blend::multiply);
    geometry.draw_shades(plain, front_view);
    geometry.screens().draw(in_view);
    gl::blend(gl::Blend::replace);
    gl::check("drawing a sun's view through shades");
    return from_rows_below(target.read_colour(), width, height);
  }

  // Marks what the casters cover; depth and colour stay as they are.
  gl::stencil(gl::Test::always, 1, gl::OnPass::replace);
  gl::cut_at_plane(true);
  gl::write_colour(false);
  geometry.draw_surfaces(plain_, plain, front_view);
  gl::write_colour(true);

  // The receiver over all of it: what hides it from the sun shows as blue.
  gl::cut_at_plane(false);
  plain_.set(0, faces_sun ? yellow : blue);
  gl::stencil(gl::Test::not_equal, 1, gl::OnPass::keep);
  geometry.draw_surfaces(plain_, itself, whole_view);
  plain_.set(0, blue);
  gl::stencil(gl::Test::equal, 1, gl::OnPass::keep);
  geometry.draw_surfaces(plain_, itself, whole_view);

  gl::check("drawing a sun's view");
  return from_rows_below(target.read_colour(), width, height);
}

}  // namespace gpu_shading
