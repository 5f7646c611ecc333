#include "gpu_shading/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "egl/device.h"
#include "gpu_shading/error.h"
#include "render/coverage.h"
#include "render/geometry.h"
#include "render/interior.h"
#include "render/luminance.h"
#include "render/picture.h"
#include "render/receiver.h"
#include "render/schedule_keys.h"
#include "render/scheduled_luminance.h"
#include "scene/casters.h"
#include "scene/screens.h"
#include "scene/shades.h"

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

RendererStatistics& RendererStatistics::operator+=(RendererStatistics const& other) {
  directions += other.directions;
  receivers_drawn += other.receivers_drawn;
  receivers_clear += other.receivers_clear;
  casters_drawn += other.casters_drawn;
  luminance_views += other.luminance_views;
  seconds += other.seconds;
  return *this;
}

class Renderer::Implementation {
 public:
  Implementation(Scene scene, RendererOptions options);
  ~Implementation();
  Implementation(Implementation const&) = delete;
  Implementation& operator=(Implementation const&) = delete;

  std::vector<Sunlit> projected_sunlit_areas(SunDirection sun,
                                             std::span<SurfaceId const> receivers);
  std::vector<Sunlit> interior_sunlit_areas(SunDirection sun, SurfaceId window,
                                            std::span<SurfaceId const> interiors);
  Image sun_view(SunDirection sun, SurfaceId receiver, int size, std::span<double const> factors);

  void set_deployments(std::vector<double> shares) { deployments_ = std::move(shares); }

  Scene const& scene() const { return scene_; }
  DeviceInfo const& device() const { return device_.info; }
  RendererStatistics const& statistics() const { return statistics_; }

 private:
  // What lives on the device, made and ended with its context current.
  struct OnDevice {
    OnDevice(Scene const& scene, Screens const& screens, int resolution)
        : geometry(scene, screens) {
      coverage.try_emplace(resolution, resolution);
    }

    Geometry geometry;
    // By the side of their tiles.
    std::map<int, Coverage> coverage;
    std::map<int, Luminance> luminance;
    std::map<int, ScheduledLuminance> scheduled;
    std::map<int, Interior> interior;
    std::map<int, InteriorLuminance> interior_luminance;
    std::optional<Picture> picture;
  };

  Surface const& surface(SurfaceId id) const;  // throws Error when there is none
  Receiver& receiver(SurfaceId id);
  Range add_surfaces(std::span<SurfaceId const> surfaces);
  // Counts the pixels of those receivers that are not known yet.
  void measure(std::span<SurfaceId const> receivers);

  bool any_transmits(std::span<SurfaceId const> casters) const;
  // Of the whole scene, right for these casters.
  std::vector<Shade> shades_of(std::span<SurfaceId const> casters,
                               glm::dvec3 const& towards_sun) const;
  std::vector<SurfaceId> plain_among(std::span<SurfaceId const> casters) const;
  std::vector<int> screens_among(std::span<SurfaceId const> casters) const;
  // Gives the list what these casters let through.
  void see_through(DrawList& list, std::span<SurfaceId const> casters,
                   glm::dvec3 const& towards_sun) const;
  // Nothing when none of the casters has a schedule.
  std::optional<ScheduleKeys> keys_of(SurfaceId id, std::span<SurfaceId const> casters) const;
  ReceiverJob add_view(Receiver const& seen, std::span<SurfaceId const> casters,
                       glm::dvec3 const& towards_sun);
  Sunlit sunlit_of(LuminanceByKey const& sums, ScheduleKeys const* keys, Receiver const& seen,
                   double cosine) const;

  Scene scene_;
  RendererOptions options_;
  Casters casters_;
  Shades shades_;
  Screens screens_;
  egl::Device device_;
  std::unique_ptr<OnDevice> on_device_;
  std::unordered_map<SurfaceId, Receiver> receivers_;
  std::vector<double> deployments_;
  DrawList draw_list_;
  RendererStatistics statistics_;
};

Renderer::Implementation::Implementation(Scene scene, RendererOptions options)
    : scene_(std::move(scene)),
      options_(options),
      casters_(scene_),
      shades_(scene_),
      screens_(scene_),
      device_(egl::open_device(options.device)) {
  Stopwatch const watch(statistics_.seconds);
  if (options_.resolution < 1 || options_.resolution > device_.info.max_resolution) {
    throw Error(fmt::format("resolution {}: expected 1 to {} pixels, the range of the device '{}'",
                            options_.resolution, device_.info.max_resolution,
                            device_.info.renderer));
  }
  if (options_.luminance_sum == LuminanceSum::automatic) {
    options_.luminance_sum = device_.info.software ? LuminanceSum::readback : LuminanceSum::compute;
  }
  egl::Current const current = device_.context.make_current();
  on_device_ = std::make_unique<OnDevice>(scene_, screens_, options_.resolution);
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

std::vector<Shade> Renderer::Implementation::shades_of(std::span<SurfaceId const> casters,
                                                       glm::dvec3 const& towards_sun) const {
  std::vector<Shade> shades(scene_.size());
  for (SurfaceId const id : casters) {
    if (!shades_.transmits(id)) continue;
    shades[id].transmittance = static_cast<float>(shades_.transmittance(scene_, id, towards_sun));
    shades[id].schedule = shades_.schedule(id);
  }
  return shades;
}

std::vector<SurfaceId> Renderer::Implementation::plain_among(
    std::span<SurfaceId const> casters) const {
  std::vector<SurfaceId> plain;
  std::copy_if(casters.begin(), casters.end(), std::back_inserter(plain),
               [&](SurfaceId id) { return shades_.dims(id); });
  return plain;
}

std::vector<int> Renderer::Implementation::screens_among(std::span<SurfaceId const> casters) const {
  std::vector<int> numbers;
  for (SurfaceId const id : casters) {
    if (screens_.number(id) != Screens::none) numbers.push_back(screens_.number(id));
  }
  return numbers;
}

void Renderer::Implementation::see_through(DrawList& list, std::span<SurfaceId const> casters,
                                           glm::dvec3 const& towards_sun) const {
  list.set_shades(shades_of(casters, towards_sun));
  std::vector<int> const numbers = screens_among(casters);
  if (numbers.empty()) return;
  list.set_screen_view(see_screens(screens_, numbers, list.by_effect(), towards_sun, deployments_,
                                   on_device_->geometry.screens().most_texels()));
}

bool Renderer::Implementation::any_transmits(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return shades_.transmits(id); });
}

std::optional<ScheduleKeys> Renderer::Implementation::keys_of(
    SurfaceId id, std::span<SurfaceId const> casters) const {
  std::vector<int> passed;
  for (SurfaceId const caster : casters) {
    if (shades_.schedule(caster) != Shades::unscheduled) passed.push_back(shades_.schedule(caster));
  }
  if (passed.empty()) return std::nullopt;
  auto keys = ScheduleKeys::make(passed, static_cast<int>(shades_.schedules().size()));
  if (!keys) {
    std::sort(passed.begin(), passed.end());
    auto const distinct = std::unique(passed.begin(), passed.end()) - passed.begin();
    throw Error(fmt::format(
        "surface '{}' sees the sun through {} shades with {} different transmittance schedules, "
        "too many to be told apart; let shades share schedules",
        surface(id).name, passed.size(), distinct));
  }
  return keys;
}

Sunlit Renderer::Implementation::sunlit_of(LuminanceByKey const& sums, ScheduleKeys const* keys,
                                           Receiver const& seen, double cosine) const {
  double const share = seen.area * cosine / static_cast<double>(*seen.pixels);
  Sunlit answer;
  for (auto const& [key, sum] : sums) {
    std::vector<std::pair<int, int>> powers;
    if (keys != nullptr) powers = keys->powers(key);
    if (powers.empty()) {
      answer.projected_area = sum * share;
      answer.pixel_counted_area = sum * seen.tile.pixel_area * cosine;
      continue;
    }
    for (auto& [schedule, power] : powers) {
      schedule = shades_.schedules()[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), sum * share});
  }
  return answer;
}

ReceiverJob Renderer::Implementation::add_view(Receiver const& seen,
                                               std::span<SurfaceId const> casters,
                                               glm::dvec3 const& towards_sun) {
  ReceiverJob job;
  job.view = draw_list_.add_view(view_in_front(*seen.frame, seen.tile.map, towards_sun),
                                 on_device_->geometry.scene_origin());
  job.casters = add_surfaces(plain_among(casters));
  job.screens = on_device_->geometry.screens().add_to(
      draw_list_, screens_among(casters), towards_sun,
      seen.tile.map.pixel_area(seen.tile.side) * glm::dot(seen.frame->normal, towards_sun));
  job.tile = draw_list_.add_tile(seen.tile.triangles);
  return job;
}

std::vector<Sunlit> Renderer::Implementation::projected_sunlit_areas(
    SunDirection sun, std::span<SurfaceId const> receivers) {
  Stopwatch const watch(statistics_.seconds);
  ++statistics_.directions;
  glm::dvec3 const towards_sun = to_vector(sun);
  std::vector<Sunlit> answers(receivers.size());
  struct Drawn {
    std::size_t place;  // of the answer
    std::vector<SurfaceId> casters;
  };
  std::vector<Drawn> drawn;
  std::vector<SurfaceId> ids;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    Receiver const& seen = receiver(receivers[i]);
    if (!seen.frame) continue;
    double const cosine = glm::dot(seen.frame->normal, towards_sun);
    if (cosine <= edge_on) continue;
    answers[i].projected_area = answers[i].pixel_counted_area = seen.area * cosine;
    std::vector<SurfaceId> casters =
        casters_.in_view(scene_, receivers[i], *seen.frame, towards_sun);
    if (casters.empty()) {
      ++statistics_.receivers_clear;
      continue;
    }
    ++statistics_.receivers_drawn;
    statistics_.casters_drawn += casters.size();
    drawn.push_back({i, std::move(casters)});
    ids.push_back(receivers[i]);
  }
  if (drawn.empty()) return answers;
  measure(ids);

  // By the side of their tiles and the cheapest way that will do.
  struct Views {
    std::vector<ReceiverJob> jobs;
    std::vector<std::size_t> places;
    std::vector<ScheduleKeys> keys;
  };
  struct Ways {
    Views opaque;
    Views unscheduled;
    Views scheduled;
  };
  std::map<int, Ways> by_side;
  draw_list_.clear();
  std::vector<SurfaceId> transmitting;
  for (Drawn const& one : drawn) {
    SurfaceId const id = receivers[one.place];
    Receiver const& seen = receiver(id);
    Ways& ways = by_side[seen.tile.side];
    Views* views = &ways.opaque;
    ReceiverJob job = add_view(seen, one.casters, towards_sun);
    if (any_transmits(one.casters)) {
      ++statistics_.luminance_views;
      transmitting.insert(transmitting.end(), one.casters.begin(), one.casters.end());
      views = &ways.unscheduled;
      if (auto keys = keys_of(id, one.casters)) {
        views = &ways.scheduled;
        job.first_key = draw_list_.add_keys(keys->keys());
        views->keys.push_back(std::move(*keys));
      }
    }
    views->jobs.push_back(job);
    views->places.push_back(one.place);
  }
  if (!transmitting.empty()) {
    std::sort(transmitting.begin(), transmitting.end());
    transmitting.erase(std::unique(transmitting.begin(), transmitting.end()), transmitting.end());
    see_through(draw_list_, transmitting, towards_sun);
  }

  egl::Current const current = device_.context.make_current();
  on_device_->geometry.upload(draw_list_);
  for (auto const& [side, ways] : by_side) {
    if (!ways.opaque.jobs.empty()) {
      on_device_->coverage.try_emplace(side, side)
          .first->second.draw(on_device_->geometry, ways.opaque.jobs);
    }
    if (!ways.unscheduled.jobs.empty()) {
      on_device_->luminance.try_emplace(side, side, options_.luminance_sum)
          .first->second.draw(on_device_->geometry, ways.unscheduled.jobs);
    }
  }
  auto const set = [&](std::size_t place, LuminanceByKey const& sums, ScheduleKeys const* keys) {
    Receiver const& seen = receiver(receivers[place]);
    answers[place] = sunlit_of(sums, keys, seen, glm::dot(seen.frame->normal, towards_sun));
  };
  for (auto const& [side, ways] : by_side) {
    if (!ways.opaque.jobs.empty()) {
      std::vector<std::uint64_t> const lit = on_device_->coverage.at(side).counts();
      for (std::size_t i = 0; i < lit.size(); ++i) {
        set(ways.opaque.places[i], {{{}, static_cast<double>(lit[i])}}, nullptr);
      }
    }
    if (!ways.unscheduled.jobs.empty()) {
      std::vector<double> const sums = on_device_->luminance.at(side).sums();
      for (std::size_t i = 0; i < sums.size(); ++i) {
        set(ways.unscheduled.places[i], {{{}, sums[i]}}, nullptr);
      }
    }
    if (!ways.scheduled.jobs.empty()) {
      std::vector<LuminanceByKey> const sums =
          on_device_->scheduled.try_emplace(side, side)
              .first->second.sum(on_device_->geometry, ways.scheduled.jobs);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        set(ways.scheduled.places[i], sums[i], &ways.scheduled.keys[i]);
      }
    }
  }
  return answers;
}

std::vector<Sunlit> Renderer::Implementation::interior_sunlit_areas(
    SunDirection sun, SurfaceId window, std::span<SurfaceId const> interiors) {
  Stopwatch const watch(statistics_.seconds);
  glm::dvec3 const towards_sun = to_vector(sun);
  std::vector<Sunlit> answers(interiors.size());
  Receiver const& seen = receiver(window);
  if (!seen.frame) return answers;
  double const cosine = glm::dot(seen.frame->normal, towards_sun);
  if (cosine <= edge_on) return answers;

  double reach = clearance;
  for (SurfaceId const id : interiors) {
    for (glm::dvec3 const& vertex : surface(id).polygon.outline) {
      reach = std::max(reach, -glm::dot(seen.frame->normal, vertex - seen.frame->origin));
    }
  }
  reach *= 1.01;  // what lies at the far end is not nearer than nothing
  measure({&window, 1});
  std::vector<SurfaceId> const casters = casters_.in_view(scene_, window, *seen.frame, towards_sun);
  draw_list_.clear();
  ReceiverJob in_front = add_view(seen, casters, towards_sun);
  std::size_t const behind_view =
      draw_list_.add_view(view_behind(*seen.frame, seen.tile.map, towards_sun, reach),
                          on_device_->geometry.scene_origin());
  std::vector<Range> surfaces;
  for (SurfaceId const id : interiors) surfaces.push_back(add_surfaces({&id, 1}));
  bool const transmits = any_transmits(casters);
  std::optional<ScheduleKeys> const keys = keys_of(window, casters);
  if (transmits) see_through(draw_list_, casters, towards_sun);
  if (keys) in_front.first_key = draw_list_.add_keys(keys->keys());

  egl::Current const current = device_.context.make_current();
  on_device_->geometry.upload(draw_list_);
  int const side = seen.tile.side;
  if (transmits) {
    InteriorLuminance& interior =
        on_device_->interior_luminance.try_emplace(side, side).first->second;
    std::vector<LuminanceByKey> const sums =
        interior.sum(on_device_->geometry, {in_front, behind_view, surfaces});
    for (std::size_t i = 0; i < sums.size(); ++i) {
      answers[i] = sunlit_of(sums[i], keys ? &*keys : nullptr, seen, cosine);
    }
  } else {
    Interior& interior = on_device_->interior.try_emplace(side, side).first->second;
    std::vector<std::uint64_t> const counts =
        interior.count(on_device_->geometry, {in_front, behind_view, surfaces});
    for (std::size_t i = 0; i < counts.size(); ++i) {
      answers[i] = sunlit_of({{{}, static_cast<double>(counts[i])}}, nullptr, seen, cosine);
    }
  }
  return answers;
}

Image Renderer::Implementation::sun_view(SunDirection sun, SurfaceId id, int size,
                                         std::span<double const> factors) {
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
      faces_sun ? casters_.in_view(scene_, id, *seen.frame, towards_sun) : std::vector<SurfaceId>();
  Picture::Shading shading;
  shading.plain = plain_among(casters);
  shading.screens_in_view = screens_among(casters);
  shading.all_screens.resize(screens_.entries().size());
  std::iota(shading.all_screens.begin(), shading.all_screens.end(), 0);
  shading.deployments = deployments_;
  if (any_transmits(casters)) {
    shading.shades = shades_of(casters, towards_sun);
    for (SurfaceId const caster : casters) {
      auto const schedule = static_cast<std::size_t>(std::max(0, scene_[caster].schedule));
      if (scene_[caster].schedule < 0 || schedule >= factors.size()) continue;
      shading.shades[caster].transmittance *= static_cast<float>(factors[schedule]);
    }
  }
  egl::Current const current = device_.context.make_current();
  if (!on_device_->picture) on_device_->picture.emplace();
  return on_device_->picture->draw(on_device_->geometry, scene_, screens_, id, *seen.frame, shading,
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

void Renderer::set_deployments(std::vector<double> shares) {
  implementation_->set_deployments(std::move(shares));
}

std::vector<Sunlit> Renderer::projected_sunlit_areas(SunDirection sun,
                                                     std::span<SurfaceId const> receivers) {
  return implementation_->projected_sunlit_areas(sun, receivers);
}

std::vector<Sunlit> Renderer::interior_sunlit_areas(SunDirection sun, SurfaceId window,
                                                    std::span<SurfaceId const> interiors) {
  return implementation_->interior_sunlit_areas(sun, window, interiors);
}

Image Renderer::sun_view(SunDirection sun, SurfaceId receiver, int size,
                         std::span<double const> factors) {
  return implementation_->sun_view(sun, receiver, size, factors);
}

}  // namespace gpu_shading
