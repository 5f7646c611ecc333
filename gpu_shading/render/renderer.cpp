#include "gpu_shading/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_map>
#include <utility>

#include "egl/device.h"
#include "gpu_shading/error.h"
#include "render/coverage.h"
#include "render/geometry.h"
#include "render/interior.h"
#include "render/picture.h"
#include "render/receiver.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total) {}
  Stopwatch(Stopwatch const&) = delete;
  Stopwatch& operator=(Stopwatch const&) = delete;
  ~Stopwatch() {
    total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(Scene scene, RendererOptions options);
  ~Implementation();
  Implementation(Implementation const&) = delete;
  Implementation& operator=(Implementation const&) = delete;

  std::vector<Sunlit> projected_sunlit_areas(SunDirection sun,
                                             std::span<SurfaceId const> receivers);
  std::vector<double> interior_projected_sunlit_areas(SunDirection sun, SurfaceId window,
                                                      std::span<SurfaceId const> interiors);
  Image sun_view(SunDirection sun, SurfaceId receiver, int size);

  Scene const& scene() const { return scene_; }
  DeviceInfo const& device() const { return device_.info; }
  RendererStatistics const& statistics() const { return statistics_; }

 private:
  // What lives on the device, made and ended with its context current.
  struct OnDevice {
    OnDevice(Scene const& scene, int resolution) : geometry(scene) {
      coverage.try_emplace(resolution, resolution);
    }

    Geometry geometry;
    // By the side of their tiles.
    std::map<int, Coverage> coverage;
    std::map<int, Interior> interior;
    std::optional<Picture> picture;
  };

  Surface const& surface(SurfaceId id) const;  // throws Error when there is none
  Receiver& receiver(SurfaceId id);
  Range add_surfaces(std::span<SurfaceId const> surfaces);
  // Counts the pixels of those receivers that are not known yet.
  void measure(std::span<SurfaceId const> receivers);

  Scene scene_;
  RendererOptions options_;
  Casters casters_;
  egl::Device device_;
  std::unique_ptr<OnDevice> on_device_;
  std::unordered_map<SurfaceId, Receiver> receivers_;
  DrawList draw_list_;
  RendererStatistics statistics_;
};

Renderer::Implementation::Implementation(Scene scene, RendererOptions options)
    : scene_(std::move(scene)),
      options_(options),
      casters_(scene_),
      device_(egl::open_device(options.device)) {
  Stopwatch const watch(statistics_.seconds);
  if (options_.resolution < 1 || options_.resolution > device_.info.max_resolution) {
    throw Error(fmt::format("resolution {}: expected 1 to {} pixels, the range of the device '{}'",
                            options_.resolution, device_.info.max_resolution,
                            device_.info.renderer));
  }
  egl::Current const current = device_.context.make_current();
  on_device_ = std::make_unique<OnDevice>(scene_, options_.resolution);
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

Surface const& Renderer::Implementation::surface(SurfaceId id) const {
  if (id < scene_.size()) return scene_[id];
  throw Error(fmt::format("there is no surface {}: the scene has {}", id, scene_.size()));
}

Receiver& Renderer::Implementation::receiver(SurfaceId id) {
  auto const known = receivers_.find(id);
  if (known != receivers_.end()) return known->second;
  Polygon const& polygon = surface(id).polygon;
  Receiver receiver;
  receiver.area = area(polygon);
  if (receiver.area > 0.0) receiver.frame = plane_frame(polygon);
  if (receiver.frame) {
    receiver.tile =
        make_tile(polygon, *receiver.frame, options_.resolution, device_.info.max_resolution);
    receiver.in_front = casters_.in_front(scene_, id, *receiver.frame);
  }
  return receivers_.emplace(id, std::move(receiver)).first->second;
}

Range Renderer::Implementation::add_surfaces(std::span<SurfaceId const> surfaces) {
  std::size_t const begin = draw_list_.begin_surfaces();
  for (SurfaceId const id : surfaces) {
    draw_list_.add_triangles(on_device_->geometry.triangles(id));
  }
  return draw_list_.end_surfaces(begin);
}

void Renderer::Implementation::measure(std::span<SurfaceId const> receivers) {
  std::map<int, std::vector<SurfaceId>> by_side;
  for (SurfaceId const id : receivers) {
    Receiver const& seen = receiver(id);
    if (!seen.pixels) by_side[seen.tile.side].push_back(id);
  }
  if (by_side.empty()) return;
  egl::Current const current = device_.context.make_current();
  std::vector<SurfaceId> missed;
  for (auto const& [side, ids] : by_side) {
    DrawList list;
    std::vector<Range> tiles;
    for (SurfaceId const id : ids) tiles.push_back(list.add_tile(receiver(id).tile.triangles));
    on_device_->geometry.upload(list);
    Coverage& coverage = on_device_->coverage.try_emplace(side, side).first->second;
    coverage.draw_clear(on_device_->geometry, tiles);
    std::vector<std::uint64_t> const counts = coverage.counts();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Receiver& seen = receiver(ids[i]);
      if (counts[i] > 0) {
        seen.pixels = counts[i];
      } else {
        seen.tile = bounding_tile(surface(ids[i]).polygon, *seen.frame, side);
        missed.push_back(ids[i]);
      }
    }
  }
  measure(missed);
}

std::vector<Sunlit> Renderer::Implementation::projected_sunlit_areas(
    SunDirection sun, std::span<SurfaceId const> receivers) {
  Stopwatch const watch(statistics_.seconds);
  ++statistics_.directions;
  glm::dvec3 const towards_sun = to_vector(sun);
  std::vector<Sunlit> answers(receivers.size());
  struct Asked {
    std::size_t place;  // of the answer
    std::vector<SurfaceId> casters;
  };
  std::map<int, std::vector<Asked>> by_side;
  std::vector<SurfaceId> drawn;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    Receiver const& seen = receiver(receivers[i]);
    if (!seen.frame) continue;
    double const cosine = glm::dot(seen.frame->normal, towards_sun);
    if (cosine <= edge_on) continue;
    answers[i].projected_area = answers[i].pixel_counted_area = seen.area * cosine;
    std::vector<SurfaceId> casters = casters_.in_view(seen.in_front, *seen.frame, towards_sun);
    if (casters.empty()) {
      ++statistics_.receivers_clear;
      continue;
    }
    ++statistics_.receivers_drawn;
    statistics_.casters_drawn += casters.size();
    by_side[seen.tile.side].push_back({i, std::move(casters)});
    drawn.push_back(receivers[i]);
  }
  if (drawn.empty()) return answers;
  measure(drawn);

  draw_list_.clear();
  std::map<int, std::vector<Coverage::Job>> jobs;
  for (auto const& [side, asked] : by_side) {
    for (Asked const& one : asked) {
      Receiver const& seen = receiver(receivers[one.place]);
      Coverage::Job job;
      job.view = draw_list_.add_view(view_in_front(*seen.frame, seen.tile.map, towards_sun),
                                     on_device_->geometry.scene_origin());
      job.casters = add_surfaces(one.casters);
      job.tile = draw_list_.add_tile(seen.tile.triangles);
      jobs[side].push_back(job);
    }
  }
  egl::Current const current = device_.context.make_current();
  on_device_->geometry.upload(draw_list_);
  for (auto const& [side, of_side] : jobs) {
    on_device_->coverage.try_emplace(side, side).first->second.draw(on_device_->geometry, of_side);
  }
  for (auto const& [side, asked] : by_side) {
    std::vector<std::uint64_t> const lit = on_device_->coverage.at(side).counts();
    for (std::size_t i = 0; i < asked.size(); ++i) {
      Receiver const& seen = receiver(receivers[asked[i].place]);
      Sunlit& answer = answers[asked[i].place];
      double const cosine = glm::dot(seen.frame->normal, towards_sun);
      auto const count = static_cast<double>(lit[i]);
      answer.projected_area *= count / static_cast<double>(*seen.pixels);
      answer.pixel_counted_area = count * seen.tile.pixel_area * cosine;
    }
  }
  return answers;
}

std::vector<double> Renderer::Implementation::interior_projected_sunlit_areas(
    SunDirection sun, SurfaceId window, std::span<SurfaceId const> interiors) {
  Stopwatch const watch(statistics_.seconds);
  glm::dvec3 const towards_sun = to_vector(sun);
  std::vector<double> answers(interiors.size(), 0.0);
  Receiver const& seen = receiver(window);
  if (!seen.frame) return answers;
  double const cosine = glm::dot(seen.frame->normal, towards_sun);
  if (cosine <= edge_on) return answers;
  measure({&window, 1});

  double reach = clearance;
  for (SurfaceId const id : interiors) {
    for (glm::dvec3 const& vertex : surface(id).polygon.outline) {
      reach = std::max(reach, -glm::dot(seen.frame->normal, vertex - seen.frame->origin));
    }
  }
  draw_list_.clear();
  glm::dvec3 const& scene_origin = on_device_->geometry.scene_origin();
  Interior::Job job;
  job.casters_view =
      draw_list_.add_view(view_in_front(*seen.frame, seen.tile.map, towards_sun), scene_origin);
  job.casters = add_surfaces(casters_.in_view(seen.in_front, *seen.frame, towards_sun));
  job.window = draw_list_.add_tile(seen.tile.triangles);
  job.behind_view = draw_list_.add_view(view_behind(*seen.frame, seen.tile.map, towards_sun, reach),
                                        scene_origin);
  for (SurfaceId const id : interiors) job.surfaces.push_back(add_surfaces({&id, 1}));

  egl::Current const current = device_.context.make_current();
  on_device_->geometry.upload(draw_list_);
  Interior& interior =
      on_device_->interior.try_emplace(seen.tile.side, seen.tile.side).first->second;
  std::vector<std::uint64_t> const counts = interior.count(on_device_->geometry, job);
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    answers[i] =
        seen.area * cosine * static_cast<double>(counts[i]) / static_cast<double>(*seen.pixels);
  }
  return answers;
}

Image Renderer::Implementation::sun_view(SunDirection sun, SurfaceId id, int size) {
  Stopwatch const watch(statistics_.seconds);
  if (size < 1 || size > device_.info.max_resolution) {
    throw Error(fmt::format("size {} of a sun's view: expected 1 to {} pixels", size,
                            device_.info.max_resolution));
  }
  Receiver const& seen = receiver(id);
  if (!seen.frame) {
    throw Error(fmt::format("surface '{}' has no area: there is no view of it", surface(id).name));
  }
  glm::dvec3 const towards_sun = to_vector(sun);
  bool const faces_sun = glm::dot(seen.frame->normal, towards_sun) > edge_on;
  std::vector<SurfaceId> const casters =
      faces_sun ? casters_.in_view(seen.in_front, *seen.frame, towards_sun)
                : std::vector<SurfaceId>();
  egl::Current const current = device_.context.make_current();
  if (!on_device_->picture) on_device_->picture.emplace();
  return on_device_->picture->draw(on_device_->geometry, scene_, id, *seen.frame, casters,
                                   towards_sun, size);
}

Renderer::Renderer(Scene scene, RendererOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(scene), options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Scene const& Renderer::scene() const { return implementation_->scene(); }
DeviceInfo const& Renderer::device() const { return implementation_->device(); }
RendererStatistics const& Renderer::statistics() const { return implementation_->statistics(); }

std::vector<Sunlit> Renderer::projected_sunlit_areas(SunDirection sun,
                                                     std::span<SurfaceId const> receivers) {
  return implementation_->projected_sunlit_areas(sun, receivers);
}

std::vector<double> Renderer::interior_projected_sunlit_areas(
    SunDirection sun, SurfaceId window, std::span<SurfaceId const> interiors) {
  return implementation_->interior_projected_sunlit_areas(sun, window, interiors);
}

Image Renderer::sun_view(SunDirection sun, SurfaceId receiver, int size) {
  return implementation_->sun_view(sun, receiver, size);
}

}  // namespace gpu_shading
