#include "gpu_shading/renderer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "backends/open_backend.h"
#include "filters/transmission.h"
#include "geometry/triangulation.h"
#include "gpu_shading/error.h"
#include "pictures/receiver_picture.h"
#include "platform/stopwatch.h"
#include "render/question_batch.h"
#include "render/receivers.h"
#include "render/renderer_with_backend.h"
#include "scene/casters.h"
#include "view/tile_size.h"

namespace gpu_shading {
namespace {

TileSize tile_size(RendererOptions const& options, DeviceInfo const& device) {
  if (!options.resolution) {
    if (!(options.error >= RendererOptions::min_error &&
          options.error <= RendererOptions::max_error)) {
      throw Error(fmt::format("error {}: expected {} to {}", options.error,
                              RendererOptions::min_error, RendererOptions::max_error));
    }
    // Layers of more pixels would fill a GPU's memory.
    constexpr int max_drawn = 4096;
    bool const drawn = !device.id.is_cpu();
    return TileSize::for_error(
        options.error, drawn ? std::min(max_drawn, device.max_resolution) : device.max_resolution);
  }
  if (*options.resolution < 1 || *options.resolution > device.max_resolution) {
    throw Error(fmt::format("resolution {}: expected 1 to {} pixels, the range of the device '{}'",
                            *options.resolution, device.max_resolution, device.renderer));
  }
  return TileSize::fixed(*options.resolution);
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
  using OpenBackend = RendererWithBackend::Open;

  Implementation(Scene scene, RendererOptions options, OpenBackend const& open);
  ~Implementation() = default;
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
  DeviceInfo const& device() const { return backend_->device(); }
  RendererStatistics const& statistics() const { return statistics_; }

 private:
  QuestionBatch& new_batch() {
    check_process();
    batch_->start();
    return *batch_;
  }

  // A context of OpenGL's does not survive a fork; the CPU's back end does.
  void check_process() const {
    if (device().id.is_cpu() || getpid() == process_) return;
    throw DeviceError(fmt::format(
        "{}: this process was forked from the one that opened the device: open it after "
        "forking, or compute on the CPU",
        device().renderer));
  }

  // What each caster transmits, with factors for schedules; 1 where there are too few.
  std::vector<Shade> shades_at(ShadedReceiver const& shaded, std::span<double const> factors) const;

  pid_t process_ = getpid();
  Scene scene_;
  Casters casters_;
  Transmission transmission_;
  RendererOptions options_;
  RendererStatistics statistics_;
  std::unique_ptr<ViewBackend> backend_;
  std::optional<Receivers> receivers_;
  std::optional<QuestionBatch> batch_;
  std::unique_ptr<PictureRaster> picture_raster_;  // once asked for
};

Renderer::Implementation::Implementation(Scene scene, RendererOptions options,
                                         OpenBackend const& open)
    : scene_(std::move(scene)),
      casters_(scene_),
      transmission_(scene_),
      options_(std::move(options)) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<Mesh> const meshes = triangulate_all(scene_);
  backend_ = open({scene_, meshes, transmission_, statistics_});
  receivers_.emplace(scene_, casters_, transmission_, tile_size(options_, device()),
                     device().max_resolution);
  batch_.emplace(QuestionBatch::Parts{scene_, casters_, transmission_, *receivers_, *backend_,
                                      statistics_, options_.samples_only});
}

std::vector<std::vector<Sunlit>> Renderer::Implementation::projected_sunlit_areas(
    std::span<SunDirection const> suns, std::span<SurfaceId const> receivers) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<std::vector<Sunlit>> answers(suns.size(), std::vector<Sunlit>(receivers.size()));
  QuestionBatch& batch = new_batch();
  for (std::size_t direction = 0; direction < suns.size(); ++direction) {
    ++statistics_.directions;
    glm::dvec3 const towards_sun = to_vector(suns[direction]);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      batch.ask({receivers[i], towards_sun, false, {}, {&answers[direction][i], 1}});
    }
  }
  batch.finish();
  return answers;
}

std::vector<std::vector<std::vector<Sunlit>>> Renderer::Implementation::interior_sunlit_areas(
    std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions) {
  Stopwatch const watch(statistics_.seconds);
  std::vector<std::vector<Sunlit>> unlit;
  unlit.reserve(questions.size());
  for (InteriorQuestion const& question : questions) unlit.emplace_back(question.interiors.size());
  std::vector<std::vector<std::vector<Sunlit>>> answers(suns.size(), unlit);
  QuestionBatch& batch = new_batch();
  for (std::size_t direction = 0; direction < suns.size(); ++direction) {
    glm::dvec3 const towards_sun = to_vector(suns[direction]);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      batch.ask(
          {questions[i].window, towards_sun, true, questions[i].interiors, answers[direction][i]});
    }
  }
  batch.finish();
  return answers;
}

std::vector<Shade> Renderer::Implementation::shades_at(ShadedReceiver const& shaded,
                                                       std::span<double const> factors) const {
  std::vector<Shade> shades;
  for (SurfaceId const caster : shaded.casters) {
    Shade shade = transmission_.shade(caster, shaded.towards_sun);
    int const schedule = scene_[caster].filter.schedule;
    if (schedule >= 0 && static_cast<std::size_t>(schedule) < factors.size()) {
      shade.transmittance *= static_cast<float>(factors[static_cast<std::size_t>(schedule)]);
    }
    shade.schedule = Shade::unscheduled;
    shades.push_back(shade);
  }
  return shades;
}

Image Renderer::Implementation::sun_view(SunDirection sun, SurfaceId id, int size,
                                         std::span<double const> factors) {
  Stopwatch const watch(statistics_.seconds);
  check_process();
  if (size < 1 || size > device().max_resolution) {
    throw Error(fmt::format("size {} of a sun's view: expected 1 to {} pixels", size,
                            device().max_resolution));
  }
  Receiver const& seen = (*receivers_)[id];
  if (!seen.frame) {
    throw Error(fmt::format("surface '{}' has no area and cannot be viewed", scene_[id].name));
  }
  glm::dvec3 const towards_sun = to_vector(sun);
  bool const faces_sun = glm::dot(seen.frame->normal, towards_sun) > edge_on;
  ShadedReceiver shaded{id, towards_sun, {}, {}};
  if (faces_sun) {
    shaded.casters = casters_.in_view(scene_, id, *seen.frame, towards_sun).casters;
  }
  if (transmission_.any_transmits(shaded.casters)) shaded.shades = shades_at(shaded, factors);
  if (!picture_raster_) {
    std::vector<Mesh> const meshes = triangulate_all(scene_);
    // The CPU may have taken over.
    DeviceChoice const choice{device().id, options_.device.debug};
    picture_raster_ = open_picture_raster({scene_, meshes, transmission_}, choice);
  }
  return draw_receiver(*picture_raster_, scene_, shaded, *seen.frame, size);
}

Renderer::Renderer(Scene scene, RendererOptions options)
    : implementation_(std::make_unique<Implementation>(
          std::move(scene), options, [&](BackendInput const& input) {
            return open_checked_backend(input, options.device, options.warn);
          })) {}
Renderer::Renderer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Renderer RendererWithBackend::make(Scene scene, RendererOptions options, Open const& open) {
  return Renderer(
      std::make_unique<Renderer::Implementation>(std::move(scene), std::move(options), open));
}
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
