#include "gpu_shading/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "egl/device.h"
#include "gl/limits.h"
#include "gpu_shading/error.h"
#include "render/coverage.h"
#include "render/geometry.h"
#include "render/picture.h"
#include "render/receivers.h"
#include "render/round.h"
#include "render/stopwatch.h"
#include "render/submissions.h"
#include "render/tile_size.h"
#include "render/transmission.h"
#include "scene/casters.h"
#include "scene/triangulation.h"

namespace gpu_shading {
namespace {

TileSize tile_size(RendererOptions const& options, DeviceInfo const& device) {
  if (!options.resolution) {
    if (!(options.error >= RendererOptions::least_error &&
          options.error <= RendererOptions::most_error)) {
      throw Error(fmt::format("error {}: expected {} to {}", options.error,
                              RendererOptions::least_error, RendererOptions::most_error));
    }
    return TileSize::for_error(options.error, device.max_resolution);
  }
  if (*options.resolution < 1 || *options.resolution > device.max_resolution) {
    throw Error(fmt::format("resolution {}: expected 1 to {} pixels, the range of the device '{}'",
                            *options.resolution, device.max_resolution, device.renderer));
  }
  return TileSize::fixed(*options.resolution);
}

RendererOptions settled(RendererOptions options, DeviceInfo const& device) {
  if (options.luminance_sum == LuminanceSum::automatic) {
    options.luminance_sum = device.software ? LuminanceSum::readback : LuminanceSum::compute;
  }
  if (options.plain_views == PlainViews::automatic) {
    options.plain_views = device.software ? PlainViews::counted : PlainViews::drawn;
  }
  return options;
}

// As the public header says. In software device memory is best small enough for the CPU's cache:
// with 4 MiB and three under way 500 panes over 20 receivers took 10 to 25 % more of the CPU.
Bounds bounds_of(RendererOptions const& options, DeviceInfo const& device) {
  constexpr std::size_t mib = std::size_t{1} << 20U;
  gl::Limits const limits = gl::query_limits();
  Bounds bounds;
  bounds.in_flight = device.software ? 1 : 3;
  bounds.target = (device.software ? 1 : 32) * mib;
  bounds.all_targets = (device.software ? 64 : 512) * mib;
  bounds.layers = limits.layers_in_vertex_stage ? limits.max_layers : 1;
  if (options.most_layers > 0) bounds.layers = std::min(bounds.layers, options.most_layers);
  return bounds;
}

}  // namespace

RendererStatistics& RendererStatistics::operator+=(RendererStatistics const& other) {
  directions += other.directions;
  receivers_drawn += other.receivers_drawn;
  receivers_clear += other.receivers_clear;
  casters_drawn += other.casters_drawn;
  luminance_views += other.luminance_views;
  seconds += other.seconds;
  cull_seconds += other.cull_seconds;
  submit_seconds += other.submit_seconds;
  count_seconds += other.count_seconds;
  wait_seconds += other.wait_seconds;
  read_seconds += other.read_seconds;
  return *this;
}

class Renderer::Implementation {
 public:
  Implementation(Scene scene, RendererOptions options);
  ~Implementation();
  Implementation(Implementation const&) = delete;
  Implementation& operator=(Implementation const&) = delete;

  std::vector<std::vector<Sunlit>> projected_sunlit_areas(std::span<SunDirection const> suns,
                                                          std::span<SurfaceId const> receivers);
  std::vector<std::vector<std::vector<Sunlit>>> interior_sunlit_areas(
      std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions);
  Image sun_view(SunDirection sun, SurfaceId receiver, int size, std::span<double const> factors);

  void set_deployments(std::vector<double> shares) {
    transmission_.set_deployments(std::move(shares));
  }

  Scene const& scene() const { return scene_; }
  DeviceInfo const& device() const { return device_.info; }
  RendererStatistics const& statistics() const { return statistics_; }

 private:
  // What lives on the device, made and ended with its context current.
  struct OnDevice {
    OnDevice(Scene const& scene, std::span<Mesh const> meshes, Transmission const& transmission,
             Bounds const& bounds, LuminanceSum how, RendererStatistics& statistics)
        : geometry(scene, meshes, transmission.screens()),
          submissions(geometry, transmission, bounds, how, statistics) {}

    Geometry geometry;
    Submissions submissions;
    std::optional<Picture> picture;
  };

  Round new_round() {
    return Round({scene_, casters_, transmission_, on_device_->geometry, receivers_,
                  on_device_->submissions, coverage_ ? &*coverage_ : nullptr, statistics_});
  }

  Scene scene_;
  Casters casters_;
  Transmission transmission_;
  egl::Device device_;
  RendererOptions options_;
  Receivers receivers_;
  std::optional<Coverage> coverage_;
  RendererStatistics statistics_;
  std::unique_ptr<OnDevice> on_device_;
};

Renderer::Implementation::Implementation(Scene scene, RendererOptions options)
    : scene_(std::move(scene)),
      casters_(scene_),
      transmission_(scene_),
      device_(egl::open_device(options.device)),
      options_(settled(options, device_.info)),
      receivers_(scene_, tile_size(options_, device_.info), device_.info.max_resolution) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<Mesh> const meshes = triangulate_all(scene_);
  if (options_.plain_views == PlainViews::counted) coverage_.emplace(meshes);
  egl::Current const current = device_.context.make_current();
  on_device_ =
      std::make_unique<OnDevice>(scene_, meshes, transmission_, bounds_of(options_, device_.info),
                                 options_.luminance_sum, statistics_);
}

Renderer::Implementation::~Implementation() {
  try {
    egl::Current const current = device_.context.make_current();
    on_device_.reset();
  } catch (DeviceError const&) {
    // A lost device keeps its objects; deleting them without a context would take someone else's.
    static_cast<void>(on_device_.release());
  }
}

std::vector<std::vector<Sunlit>> Renderer::Implementation::projected_sunlit_areas(
    std::span<SunDirection const> suns, std::span<SurfaceId const> receivers) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<std::vector<Sunlit>> answers(suns.size(), std::vector<Sunlit>(receivers.size()));
  egl::Current const current = device_.context.make_current();
  Round round = new_round();
  for (std::size_t direction = 0; direction < suns.size(); ++direction) {
    ++statistics_.directions;
    glm::dvec3 const towards_sun = to_vector(suns[direction]);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      round.ask({receivers[i], towards_sun, false, {}, {&answers[direction][i], 1}});
    }
  }
  round.finish();
  return answers;
}

std::vector<std::vector<std::vector<Sunlit>>> Renderer::Implementation::interior_sunlit_areas(
    std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<std::vector<Sunlit>> unlit;
  unlit.reserve(questions.size());
  for (InteriorQuestion const& question : questions) unlit.emplace_back(question.interiors.size());
  std::vector<std::vector<std::vector<Sunlit>>> answers(suns.size(), unlit);
  egl::Current const current = device_.context.make_current();
  Round round = new_round();
  for (std::size_t direction = 0; direction < suns.size(); ++direction) {
    glm::dvec3 const towards_sun = to_vector(suns[direction]);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      round.ask(
          {questions[i].window, towards_sun, true, questions[i].interiors, answers[direction][i]});
    }
  }
  round.finish();
  return answers;
}

Image Renderer::Implementation::sun_view(SunDirection sun, SurfaceId id, int size,
                                         std::span<double const> factors) {
  Stopwatch const watch(statistics_.seconds);
  if (size < 1 || size > device_.info.max_resolution) {
    throw Error(fmt::format("size {} of a sun's view: expected 1 to {} pixels", size,
                            device_.info.max_resolution));
  }
  Receiver const& seen = receivers_[id];
  if (!seen.frame) {
    throw Error(fmt::format("surface '{}' has no area: there is no view of it", scene_[id].name));
  }
  glm::dvec3 const towards_sun = to_vector(sun);
  bool const faces_sun = glm::dot(seen.frame->normal, towards_sun) > edge_on;
  std::vector<SurfaceId> const casters =
      faces_sun ? casters_.in_view(scene_, id, *seen.frame, towards_sun, 0.0).casters
                : std::vector<SurfaceId>();
  Picture::Shading shading;
  shading.casters = casters;
  if (transmission_.any_transmits(casters)) {
    shading.shades.resize(scene_.size());
    for (SurfaceId const caster : casters) {
      Shade& shade = shading.shades[caster] = transmission_.shade(caster, towards_sun);
      auto const schedule = static_cast<std::size_t>(std::max(0, scene_[caster].schedule));
      if (scene_[caster].schedule < 0 || schedule >= factors.size()) continue;
      shade.transmittance *= static_cast<float>(factors[schedule]);
    }
  }
  egl::Current const current = device_.context.make_current();
  if (!on_device_->picture) on_device_->picture.emplace();
  return on_device_->picture->draw(on_device_->geometry, scene_, transmission_, id, *seen.frame,
                                   shading, towards_sun, size);
}

Renderer::Renderer(Scene scene, RendererOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(scene), options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Scene const& Renderer::scene() const { return implementation_->scene(); }
DeviceInfo const& Renderer::device() const { return implementation_->device(); }
RendererStatistics const& Renderer::statistics() const { return implementation_->statistics(); }

void Renderer::set_deployments(std::vector<double> shares) {
  implementation_->set_deployments(std::move(shares));
}

std::vector<Sunlit> Renderer::projected_sunlit_areas(SunDirection sun,
                                                     std::span<SurfaceId const> receivers) {
  return std::move(implementation_->projected_sunlit_areas({&sun, 1}, receivers).front());
}

std::vector<std::vector<Sunlit>> Renderer::projected_sunlit_areas(
    std::span<SunDirection const> suns, std::span<SurfaceId const> receivers) {
  return implementation_->projected_sunlit_areas(suns, receivers);
}

std::vector<Sunlit> Renderer::interior_sunlit_areas(SunDirection sun, SurfaceId window,
                                                    std::span<SurfaceId const> interiors) {
  InteriorQuestion const question{window, {interiors.begin(), interiors.end()}};
  return std::move(
      implementation_->interior_sunlit_areas({&sun, 1}, {&question, 1}).front().front());
}

std::vector<std::vector<std::vector<Sunlit>>> Renderer::interior_sunlit_areas(
    std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions) {
  return implementation_->interior_sunlit_areas(suns, questions);
}

Image Renderer::sun_view(SunDirection sun, SurfaceId receiver, int size,
                         std::span<double const> factors) {
  return implementation_->sun_view(sun, receiver, size, factors);
}

}  // namespace gpu_shading
