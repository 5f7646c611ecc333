#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <iterator>
#include <optional>

#include "answers/cached_renderer.h"
#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "gpu_shading/scene_view.h"
#include "model/extensions/extension_fields.h"
#include "platform/staged_files.h"
#include "platform/text.h"
#include "scene/shade_motion.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

struct Drawing {
  Renderer& renderer;
  std::vector<SurfaceId> shown;        // the model's surfaces, which the user can name
  std::vector<bool> receives;          // by surface: whether it is coloured by its sunlit fraction
  std::vector<double> const& factors;  // values of schedules
  int size;                            // pixels on the longer side
  std::vector<Ring> range;             // outlines to draw over what is there
};

void darken(Image& image, int x, int y) {
  constexpr std::uint8_t ink = 30;
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  auto const at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(at), 3, ink);
}

// So that marks are legible over anything.
void lighten(Image& image, glm::ivec2 const& corner, glm::ivec2 const& end) {
  constexpr int white = 255;
  for (int y = std::max(corner.y, 0); y < std::min(end.y, image.height); ++y) {
    for (int x = std::max(corner.x, 0); x < std::min(end.x, image.width); ++x) {
      auto const at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x));
      for (std::size_t i = at; i < at + 3; ++i) {
        image.pixels[i] = static_cast<std::uint8_t>((image.pixels[i] + 4 * white) / 5);
      }
    }
  }
}

// From one place to another, pixels from the upper left corner, `thick` pixels wide.
void draw_line(Image& image, glm::dvec2 const& from, glm::dvec2 const& to, double thick) {
  double const length = glm::distance(from, to);
  double const half = 0.5 * thick;
  auto const low = glm::min(from, to) - half;
  auto const high = glm::max(from, to) + half;
  for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
    for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
      glm::dvec2 const place(x + 0.5, y + 0.5);
      double const share =
          length > 0.0 ? std::clamp(glm::dot(place - from, to - from) / (length * length), 0.0, 1.0)
                       : 0.0;
      if (glm::distance(place, from + share * (to - from)) <= half) darken(image, x, y);
    }
  }
}

// Outlines in dashes, in front of all else.
void draw_dashed(Image& image, std::vector<Ring> const& rings, ViewScale const& scale) {
  double const thick = std::max(1.2, std::min(image.width, image.height) / 500.0);
  double const dash = 5.0 * thick;
  auto const place = [&](glm::dvec3 const& point) {
    glm::dvec4 const whole(point, 1.0);
    return glm::dvec2(glm::dot(scale.across, whole), glm::dot(scale.down, whole));
  };
  for (auto const& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      auto const from = place(ring[i]);
      auto const to = place(ring[(i + 1) % ring.size()]);
      double const length = glm::distance(from, to);
      auto const dashes = static_cast<int>(std::ceil(length / (2.0 * dash)));
      for (int k = 0; k < dashes; ++k) {
        double const at = 2.0 * dash * k;
        auto const end = std::min(at + dash, length);
        draw_line(image, glm::mix(from, to, at / length), glm::mix(from, to, end / length), thick);
      }
    }
  }
}

// 1, 2 or 5 times a power of ten, at most so long.
double round_length(double max_length) {
  double const power = std::pow(10.0, std::floor(std::log10(max_length)));
  for (double const times : {5.0, 2.0}) {
    if (times * power <= max_length) return times * power;
  }
  return power;
}

// How many pixels of a part of an image differ from its upper left corner's.
std::ptrdiff_t count_drawn(Image const& image, glm::ivec2 const& low, glm::ivec2 const& high) {
  std::ptrdiff_t drawn = 0;
  for (int y = std::max(low.y, 0); y < std::min(high.y, image.height); ++y) {
    for (int x = std::max(low.x, 0); x < std::min(high.x, image.width); ++x) {
      auto const pixel =
          image.pixels.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + x);
      if (!std::equal(pixel, pixel + 3, image.pixels.begin())) ++drawn;
    }
  }
  return drawn;
}

// An image of 3 channels with an arrow to the north and a bar of a round length beside it, as the
// bytes of a file; the ending of `name` is its format. They stand in the lower left corner, or in
// the right one if less than half as much is drawn there. Throws Error.
std::string encode_with_marks(std::string const& name, Image image, ViewScale const& scale) {
  int const shorter = std::min(image.width, image.height);
  int const font = std::clamp(shorter / 28, 10, 40);
  double const thick = std::max(2.0, font / 7.0);
  double const arm = 1.7 * font;
  std::vector<Label> labels;

  constexpr double longest = 0.25;  // of the picture's width
  double const metres = round_length(longest * image.width / scale.pixels_per_metre);
  double const bar = metres * scale.pixels_per_metre;
  glm::ivec2 const plate(static_cast<int>(bar + 6.6 * font), static_cast<int>(5.4 * font));
  glm::ivec2 const size(image.width, image.height);
  glm::ivec2 low(0, size.y - plate.y);
  if (2 * count_drawn(image, size - plate, size) < count_drawn(image, low, low + plate)) {
    low = size - plate;
  }
  lighten(image, low, low + plate);
  glm::dvec2 const left(low.x + 5.6 * font, image.height - 1.2 * font);
  glm::dvec2 const right = left + glm::dvec2(bar, 0.0);

  // A compass is round from above; from elsewhere it is as flat as the ground.
  glm::dvec2 const middle(low.x + 2.6 * font, image.height - 2.6 * font);
  glm::dvec2 const north = glm::dvec2(scale.north_right, -scale.north_up) / scale.pixels_per_metre;
  auto const tip = middle + arm * north;
  draw_line(image, middle - arm * north, tip, thick);
  double const length = glm::length(north);
  if (length > 0.0) {
    auto const along = north / length;
    glm::dvec2 const across(-along.y, along.x);
    for (double const side : {-1.0, 1.0}) {
      draw_line(image, tip, tip - 0.6 * font * along + side * 0.35 * font * across, thick);
    }
    auto const letter = tip + 0.8 * font * along;
    labels.push_back(
        {static_cast<int>(letter.x), static_cast<int>(letter.y), font, LabelAlign::centre, "N"});
  }

  glm::dvec2 const tick(0.0, 0.35 * font);
  draw_line(image, left, right, thick);
  draw_line(image, left - tick, left + tick, thick);
  draw_line(image, right - tick, right + tick, thick);
  auto const between = 0.5 * (left + right);
  labels.push_back({static_cast<int>(between.x), static_cast<int>(between.y - 0.9 * font), font,
                    LabelAlign::centre, fmt::format("{:g} m", metres)});
  return encode_labelled(name, image, labels);
}

SurfaceId find(Drawing const& drawing, std::string const& name) {
  auto const wanted = upper(name);
  std::vector<std::string> names;
  for (SurfaceId const id : drawing.shown) {
    auto const& surface = drawing.renderer.scene()[id];
    if (!(area(surface.polygon) > 0.0)) continue;
    if (surface.name == wanted) return id;
    names.push_back(surface.name);
  }
  throw Error(fmt::format("receiver {}: the model has no such surface; see gpu_shading check{}",
                          name, did_you_mean(name, names)));
}

// The sunlit fractions of some surfaces, 0 for those that face away from the sun.
std::vector<double> fractions_of(Drawing const& drawing, SunDirection sun,
                                 std::vector<SurfaceId> const& surfaces) {
  auto const& scene = drawing.renderer.scene();
  auto const towards_sun = to_vector(sun);
  auto const unshaded = [&](SurfaceId id) {
    auto const& polygon = scene[id].polygon;
    return area(polygon) * glm::dot(normal(polygon), towards_sun);
  };
  std::vector<SurfaceId> lit;
  std::ranges::copy_if(surfaces, std::back_inserter(lit),
                       [&](SurfaceId id) { return unshaded(id) > 0.0; });
  auto const areas = drawing.renderer.projected_sunlit_areas(sun, lit);
  std::vector<double> fractions(surfaces.size(), 0.0);
  for (std::size_t i = 0, next = 0; i < surfaces.size() && next < lit.size(); ++i) {
    if (surfaces[i] != lit[next]) continue;
    fractions[i] = std::min(1.0, areas[next].at(drawing.factors) / unshaded(surfaces[i]));
    ++next;
  }
  return fractions;
}

// By surface, of the receivers that are shown.
std::vector<std::optional<double>> sunlit_fractions(Drawing const& drawing, SunDirection sun) {
  auto const& scene = drawing.renderer.scene();
  std::vector<SurfaceId> receivers;
  std::ranges::copy_if(drawing.shown, std::back_inserter(receivers), [&](SurfaceId id) {
    return drawing.receives[id] && area(scene[id].polygon) > 0.0;
  });
  auto const found = fractions_of(drawing, sun, receivers);
  std::vector<std::optional<double>> fractions(scene.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) fractions[receivers[i]] = found[i];
  return fractions;
}

// From elsewhere than the sun, neighbours too; as the sun sees them, they would hide what they
// shade.
std::vector<SurfaceId> shown_in(ViewsTask const& task, SceneAssembly const& scene) {
  auto ids = scene.shown();
  if (!std::ranges::all_of(task.views, [](auto const& view) { return view.camera.has_value(); })) {
    return ids;
  }
  auto const& types = scene.model().surroundings.types;
  for (SurfaceId id = 0; id < scene.surfaces().size(); ++id) {
    auto const& name = scene.surfaces()[id].name;
    auto const type = types.find(name);
    bool const context = type != types.end() && type->second == extension::site_context::type;
    if (context && !name.ends_with(":TERRAIN")) ids.push_back(id);
  }
  return ids;
}

std::string draw_whole(SceneView& scene, SunView const& view,
                       std::vector<std::optional<double>> const& fractions, int size,
                       std::vector<Ring> const& range) {
  auto const scale = scene.scale(view.camera.value_or(view.sun), fractions, size);
  auto image = view.camera ? scene.draw(*view.camera, view.sun, fractions, size)
                           : scene.draw(view.sun, fractions, size);
  draw_dashed(image, range, scale);
  if (!view.camera) return encode_image(view.picture, image);
  return encode_with_marks(view.picture, std::move(image), scale);
}

// Into a folder: all of them, or none. Returns a line for each, with the receiver's sunlit
// fraction.
std::string draw_views(std::vector<SunView> const& views, std::filesystem::path const& folder,
                       Drawing const& drawing) {
  StagedFiles files(folder);
  std::optional<SceneView> whole;
  std::string told;
  for (auto const& view : views) {
    if (view.receiver.empty()) {
      auto const fractions = sunlit_fractions(drawing, view.sun);
      // By the device that gave them, which may be the CPU in place of a GPU that was wrong.
      if (!whole) {
        whole.emplace(drawing.renderer.scene(), drawing.shown,
                      DeviceChoice{drawing.renderer.device().id});
        for (auto const& ring : drawing.range) whole->include(ring);
      }
      files.write(view.picture, draw_whole(*whole, view, fractions, drawing.size, drawing.range));
    } else {
      auto const receiver = find(drawing, view.receiver);
      files.write(view.picture, encode_image(view.picture, drawing.renderer.sun_view(
                                                               view.sun, receiver, drawing.size,
                                                               drawing.factors)));
      told += fmt::format("{:.3f}", fractions_of(drawing, view.sun, {receiver}).front());
    }
    told += '\n';
  }
  files.commit();
  return told;
}

// Of shades that move, at both ends.
std::vector<Ring> range_of(SceneAssembly const& scene) {
  std::vector<Ring> rings;
  for (auto const id : scene.shown()) {
    auto const number = scene.moving_shade_of(id);
    if (!number) continue;
    auto const& shade = scene.model().moving_shades[*number];
    for (double const position : {shade.minimum, shade.maximum}) {
      rings.push_back(moved(scene.surfaces()[id].polygon, shade, position).outline);
    }
  }
  return rings;
}

}  // namespace

std::string perform(ViewsTask const& task, SceneAssembly& scene, Messages const& messages) {
  RendererOptions options = watched_options(scene.model().options, messages);
  options.samples_only = true;  // by which the device that draws is checked
  Renderer renderer(scene.scene(), options);
  scene.optics().update({});
  renderer.set_deployments(scene.optics().deployments());
  std::vector<bool> receives(scene.surfaces().size(), false);
  for (auto const id : scene.shown_receivers()) receives[id] = true;
  return draw_views(task.views, task.folder,
                    {renderer, shown_in(task, scene), std::move(receives), scene.optics().factors(),
                     task.size, task.range ? range_of(scene) : std::vector<Ring>{}});
}

}  // namespace gpu_shading::energyplus
