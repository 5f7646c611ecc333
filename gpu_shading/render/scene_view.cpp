#include "gpu_shading/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "egl/device.h"
#include "gl/check.h"
#include "gl/draw.h"
#include "gl/framebuffer.h"
#include "gpu_shading/error.h"
#include "render/sun_axes.h"
#include "render/whole_scene.h"
#include "scene/box_tree.h"

namespace gpu_shading {
namespace {

// Samples a side of a pixel.
constexpr int samples = 2;
// Around all that is shown, as a share of its longer side.
constexpr double border = 0.04;

bool transmits(Surface const& surface) {
  return surface.transmittance || surface.screen || surface.schedule >= 0;
}

glm::dvec3 grey(Surface const& surface, glm::dvec3 const& towards_sun) {
  constexpr double dark = 95.0;
  constexpr double light = 215.0;
  return glm::dvec3(
      glm::mix(dark, light, std::abs(glm::dot(normal(surface.polygon), towards_sun))));
}

}  // namespace

glm::dvec3 fraction_colour(double fraction) {
  static std::array<glm::dvec3, 17> const steps{{{0.0, 34.0, 78.0},
                                                 {0.0, 46.0, 106.0},
                                                 {26.0, 56.0, 111.0},
                                                 {50.0, 67.0, 109.0},
                                                 {67.0, 78.0, 108.0},
                                                 {83.0, 90.0, 109.0},
                                                 {97.0, 101.0, 111.0},
                                                 {111.0, 112.0, 115.0},
                                                 {125.0, 124.0, 120.0},
                                                 {140.0, 136.0, 120.0},
                                                 {155.0, 148.0, 118.0},
                                                 {171.0, 160.0, 114.0},
                                                 {188.0, 174.0, 108.0},
                                                 {205.0, 187.0, 99.0},
                                                 {222.0, 201.0, 88.0},
                                                 {240.0, 216.0, 70.0},
                                                 {254.0, 232.0, 56.0}}};
  double const place = std::clamp(fraction, 0.0, 1.0) * (steps.size() - 1);
  auto const step = std::min(static_cast<std::size_t>(place), steps.size() - 2);
  return glm::mix(steps[step], steps[step + 1], place - static_cast<double>(step));
}

class SceneView::Implementation {
 public:
  Implementation(Scene const& scene, std::span<SurfaceId const> shown, DeviceChoice const& choice)
      : scene_(scene), shown_(shown.begin(), shown.end()), device_(egl::open_device(choice)) {
    // Those that are seen through come last.
    std::stable_partition(shown_.begin(), shown_.end(),
                          [&](SurfaceId id) { return !transmits(scene_[id]); });
    find_middle();
    std::vector<WholeScene::Vertex> vertices;
    for (SurfaceId const id : shown_) {
      WholeScene::add(vertices, id, scene_[id].polygon, middle_);
      if (!transmits(scene_[id])) opaque_ = vertices.size();
    }
    vertices_ = vertices.size();
    auto const current = device_.context.make_current();
    on_device_.emplace(vertices);
    gl::check("uploading a scene to view");
  }

  ~Implementation() {
    auto const current = device_.context.make_current();
    on_device_.reset();
  }
  Implementation(Implementation const&) = delete;
  Implementation& operator=(Implementation const&) = delete;

  Image draw(SunDirection sun, std::span<std::optional<double> const> fractions, int size) {
    if (size < 1 || samples * size > device_.info.max_resolution) {
      throw Error(fmt::format("size {} of a view: expected 1 to {} pixels", size,
                              device_.info.max_resolution / samples));
    }
    auto const towards_sun = to_vector(sun);
    PictureFrame const frame = find_frame(SunAxes(towards_sun), fractions);
    double const scale = size / frame.longer();
    auto const pixels = [&](double length) {
      return std::clamp(static_cast<int>(std::lround(scale * length)), 1, size);
    };
    Image image;
    image.width = pixels(frame.high.x - frame.low.x);
    image.height = pixels(frame.high.y - frame.low.y);

    auto const current = device_.context.make_current();
    int const columns = samples * image.width;
    int const rows = samples * image.height;
    auto const target =
        gl::Framebuffer::create({gl::Format::identity, gl::Format::depth_stencil}, columns, rows);
    on_device_->begin(target, towards_sun, frame, reach_);
    gl::draw_vertices(0, opaque_);
    auto const behind = target.read_identity();
    gl::draw_vertices(opaque_, vertices_ - opaque_);
    auto const front = target.read_identity();
    gl::check("drawing a view of a scene");

    colour(fractions, towards_sun);
    image.pixels.reserve(3 * static_cast<std::size_t>(image.width) *
                         static_cast<std::size_t>(image.height));
    for (int y = image.height - 1; y >= 0; --y) {
      for (int x = 0; x < image.width; ++x) {
        auto const colour = pixel_colour({front, behind, columns}, samples * x, samples * y);
        for (int channel = 0; channel < 3; ++channel) {
          image.pixels.push_back(static_cast<std::uint8_t>(std::lround(colour[channel])));
        }
      }
    }
    return image;
  }

 private:
  template <typename Action>
  void for_each_point(Action const& action) const {
    for (SurfaceId const id : shown_) {
      for (auto const& vertex : scene_[id].polygon.outline) action(id, vertex);
    }
  }

  void find_middle() {
    Box all;
    for_each_point([&](SurfaceId, glm::dvec3 const& point) { all.include(point); });
    if (all.empty()) throw Error("there is no surface to view");
    middle_ = all.centre();
    reach_ = std::max(1.0, glm::distance(all.low, all.high));
  }

  PictureFrame find_frame(SunAxes const& axes,
                          std::span<std::optional<double> const> fractions) const {
    PictureFrame all;
    PictureFrame receivers;
    for_each_point([&](SurfaceId id, glm::dvec3 const& point) {
      all.include(axes(point - middle_));
      if (id < fractions.size() && fractions[id]) receivers.include(axes(point - middle_));
    });
    if (!(receivers.low.x <= receivers.high.x)) throw Error("there is no receiver to view");
    PictureFrame const most = receivers.widened(0.5 * receivers.longer());
    PictureFrame const frame{glm::max(all.low, most.low), glm::min(all.high, most.high)};
    return frame.widened(border * frame.longer());
  }

  void colour(std::span<std::optional<double> const> fractions, glm::dvec3 const& towards_sun) {
    colours_.assign(scene_.size() + 1, glm::dvec3(255.0));
    for (SurfaceId const id : shown_) {
      bool const receives = id < fractions.size() && fractions[id];
      colours_[id + 1] = receives ? fraction_colour(*fractions[id]) : grey(scene_[id], towards_sun);
    }
  }

  // The surfaces that are seen, and what is behind those that transmit.
  struct Samples {
    std::vector<std::uint32_t> const& front;
    std::vector<std::uint32_t> const& behind;
    int columns;
  };

  // Of the samples from a column and a row on.
  glm::dvec3 pixel_colour(Samples const& seen, int column, int row) const {
    glm::dvec3 sum(0.0);
    for (std::size_t line = 0; line < samples; ++line) {
      for (std::size_t place = 0; place < samples; ++place) {
        auto const width = static_cast<std::size_t>(seen.columns);
        sum += sample_colour(seen, (static_cast<std::size_t>(row) + line) * width +
                                       static_cast<std::size_t>(column) + place);
      }
    }
    return sum / static_cast<double>(samples * samples);
  }

  // Half through what transmits; dark along the edges of surfaces.
  glm::dvec3 sample_colour(Samples const& seen, std::size_t at) const {
    constexpr double through = 0.5;
    constexpr double edge = 0.45;
    auto const& front = seen.front;
    auto const& behind = seen.behind;
    auto const width = static_cast<std::size_t>(seen.columns);
    auto sample = colours_[front[at]];
    if (front[at] != behind[at]) sample = glm::mix(sample, colours_[behind[at]], through);
    auto const differs = [&](std::size_t other) {
      return other < front.size() && (front[other] != front[at] || behind[other] != behind[at]);
    };
    bool const last = at % width == width - 1;
    if ((!last && differs(at + 1)) || differs(at + width)) sample *= edge;
    return sample;
  }

  Scene const& scene_;
  std::vector<SurfaceId> shown_;
  egl::Device device_;
  std::optional<WholeScene> on_device_;
  glm::dvec3 middle_{0.0};
  double reach_ = 1.0;
  std::size_t opaque_ = 0;  // vertices
  std::size_t vertices_ = 0;
  std::vector<glm::dvec3> colours_;  // by identity
};

SceneView::SceneView(Scene const& scene, std::span<SurfaceId const> shown,
                     DeviceChoice const& device)
    : implementation_(std::make_unique<Implementation>(scene, shown, device)) {}

SceneView::~SceneView() = default;

Image SceneView::draw(SunDirection sun, std::span<std::optional<double> const> fractions,
                      int size) {
  return implementation_->draw(sun, fractions, size);
}

}  // namespace gpu_shading
