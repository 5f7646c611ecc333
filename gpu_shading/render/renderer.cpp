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
#include "render/tile_size.h"
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

TileSize tile_size(RendererOptions const& options, DeviceInfo const& device) {
  if (!options.resolution) {
    if (!(options.error >= 1e-5 && options.error <= 0.1)) {
      throw Error(fmt::format("error {}: expected 1e-5 to 0.1", options.error));
    }
    return TileSize::for_error(options.error, device.max_resolution);
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
    OnDevice(Scene const& scene, Screens const& screens) : geometry(scene, screens) {}

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
  // As the detail before it asks for. The receiver has to have an area.
  Tile& tile(SurfaceId id, int side);
  int side_for(Receiver const& seen, InView const& in_view) const;
  Range add_surfaces(std::span<SurfaceId const> surfaces);
  // Counts the pixels of those receivers' tiles that are not known yet.
  struct Measured {
    SurfaceId receiver;
    int side;
  };
  void measure(std::span<Measured const> tiles);

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
  ReceiverJob add_view(Receiver const& seen, Tile const& tile, std::span<SurfaceId const> casters,
                       glm::dvec3 const& towards_sun);
  Sunlit sunlit_of(LuminanceByKey const& sums, ScheduleKeys const* keys, Receiver const& seen,
                   Tile const& tile, double cosine) const;

  Scene scene_;
  RendererOptions options_;
  Casters casters_;
  Shades shades_;
  Screens screens_;
  egl::Device device_;
  TileSize tile_size_;
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
      device_(egl::open_device(options.device)),
      tile_size_(tile_size(options_, device_.info)) {
  Stopwatch const watch(statistics_.seconds);
  if (options_.luminance_sum == LuminanceSum::automatic) {
    options_.luminance_sum = device_.info.software ? LuminanceSum::readback : LuminanceSum::compute;
  }
  egl::Current const current = device_.context.make_current();
  on_device_ = std::make_unique<OnDevice>(scene_, screens_);
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
  return receivers_.emplace(id, std::move(receiver)).first->second;
}

Tile& Renderer::Implementation::tile(SurfaceId id, int side) {
  Receiver& seen = receiver(id);
  auto const known = seen.tiles.find(side);
  if (known != seen.tiles.end()) return known->second;
  return seen.tiles
      .emplace(side, make_tile(surface(id).polygon, *seen.frame, side, device_.info.max_resolution))
      .first->second;
}

int Renderer::Implementation::side_for(Receiver const& seen, InView const& in_view) const {
  // Of the rectangle's edges and pixels the receiver has its share.
  double const share = seen.area / (seen.frame->width * seen.frame->height);
  int const side = tile_size_.side((1.0 / share) * in_view.detail);
  bool const screened =
      std::any_of(in_view.casters.begin(), in_view.casters.end(),
                  [&](SurfaceId id) { return screens_.number(id) != Screens::none; });
  return screened ? tile_size_.side_with_screens(side) : side;
}

Range Renderer::Implementation::add_surfaces(std::span<SurfaceId const> surfaces) {
  std::size_t const begin = draw_list_.begin_surfaces();
  for (SurfaceId const id : surfaces) {
    draw_list_.add_triangles(on_device_->geometry.triangles(id));
  }
  return draw_list_.end_surfaces(begin);
}

void Renderer::Implementation::measure(std::span<Measured const> tiles) {
  std::map<int, std::vector<Measured>> by_side;
  for (Measured const& wanted : tiles) {
    Tile const& known = tile(wanted.receiver, wanted.side);
    if (!known.pixels) by_side[known.side].push_back(wanted);
  }
  if (by_side.empty()) return;
  egl::Current const current = device_.context.make_current();
  std::vector<Measured> missed;
  for (auto const& [side, unknown] : by_side) {
    DrawList list;
    std::vector<Range> drawn;
    for (Measured const& one : unknown) {
      drawn.push_back(list.add_tile(tile(one.receiver, one.side).triangles));
    }
    on_device_->geometry.upload(list);
    Coverage& coverage = on_device_->coverage.try_emplace(side, side).first->second;
    coverage.draw_clear(on_device_->geometry, drawn);
    std::vector<std::uint64_t> const counts = coverage.counts();
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      auto const [id, wanted] = unknown[i];
      Tile& measured = tile(id, wanted);
      if (counts[i] > 0) {
        measured.pixels = counts[i];
      } else {
        measured = bounding_tile(surface(id).polygon, *receiver(id).frame, side);
        missed.push_back(unknown[i]);
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
                                           Receiver const& seen, Tile const& tile,
                                           double cosine) const {
  double const share = seen.area * cosine / static_cast<double>(*tile.pixels);
  Sunlit answer;
  for (auto const& [key, sum] : sums) {
    std::vector<std::pair<int, int>> powers;
    if (keys != nullptr) powers = keys->powers(key);
    if (powers.empty()) {
      answer.projected_area = sum * share;
      answer.pixel_counted_area = sum * tile.pixel_area * cosine;
      continue;
    }
    for (auto& [schedule, power] : powers) {
      schedule = shades_.schedules()[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), sum * share});
  }
  return answer;
}

ReceiverJob Renderer::Implementation::add_view(Receiver const& seen, Tile const& tile,
                                               std::span<SurfaceId const> casters,
                                               glm::dvec3 const& towards_sun) {
  ReceiverJob job;
  job.view = draw_list_.add_view(view_in_front(*seen.frame, tile.map, towards_sun),
                                 on_device_->geometry.scene_origin());
  job.casters = add_surfaces(plain_among(casters));
  job.screens = on_device_->geometry.screens().add_to(
      draw_list_, screens_among(casters), towards_sun,
      tile.map.pixel_area(tile.side) * glm::dot(seen.frame->normal, towards_sun));
  job.tile = draw_list_.add_tile(tile.triangles);
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
    int side;
  };
  std::vector<Drawn> drawn;
  std::vector<Measured> tiles;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    Receiver const& seen = receiver(receivers[i]);
    if (!seen.frame) continue;
    double const cosine = glm::dot(seen.frame->normal, towards_sun);
    if (cosine <= edge_on) continue;
    answers[i].projected_area = answers[i].pixel_counted_area = seen.area * cosine;
    InView in_view =
        casters_.in_view(scene_, receivers[i], *seen.frame, towards_sun, tile_size_.enough());
    if (in_view.casters.empty()) {
      ++statistics_.receivers_clear;
      continue;
    }
    ++statistics_.receivers_drawn;
    statistics_.casters_drawn += in_view.casters.size();
    int const side = side_for(seen, in_view);
    drawn.push_back({i, std::move(in_view.casters), side});
    tiles.push_back({receivers[i], side});
  }
  if (drawn.empty()) return answers;
  measure(tiles);

  // By the side of their tiles and the cheapest way that will do.
  struct Views {
    std::vector<ReceiverJob> jobs;
    std::vector<Drawn const*> drawn;
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
    Tile const& laid_out = tile(id, one.side);
    Ways& ways = by_side[laid_out.side];
    Views* views = &ways.opaque;
    ReceiverJob job = add_view(seen, laid_out, one.casters, towards_sun);
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
    views->drawn.push_back(&one);
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
  auto const set = [&](Drawn const& one, LuminanceByKey const& sums, ScheduleKeys const* keys) {
    SurfaceId const id = receivers[one.place];
    Receiver const& seen = receiver(id);
    answers[one.place] =
        sunlit_of(sums, keys, seen, tile(id, one.side), glm::dot(seen.frame->normal, towards_sun));
  };
  for (auto const& [side, ways] : by_side) {
    if (!ways.opaque.jobs.empty()) {
      std::vector<std::uint64_t> const lit = on_device_->coverage.at(side).counts();
      for (std::size_t i = 0; i < lit.size(); ++i) {
        set(*ways.opaque.drawn[i], {{{}, static_cast<double>(lit[i])}}, nullptr);
      }
    }
    if (!ways.unscheduled.jobs.empty()) {
      std::vector<double> const sums = on_device_->luminance.at(side).sums();
      for (std::size_t i = 0; i < sums.size(); ++i) {
        set(*ways.unscheduled.drawn[i], {{{}, sums[i]}}, nullptr);
      }
    }
    if (!ways.scheduled.jobs.empty()) {
      std::vector<LuminanceByKey> const sums =
          on_device_->scheduled.try_emplace(side, side)
              .first->second.sum(on_device_->geometry, ways.scheduled.jobs);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        set(*ways.scheduled.drawn[i], sums[i], &ways.scheduled.keys[i]);
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
  InView in_view = casters_.in_view(scene_, window, *seen.frame, towards_sun, tile_size_.enough());
  // Where one surface inside ends and the next begins there is an edge as well.
  in_view.detail.across += static_cast<double>(std::min<std::size_t>(interiors.size(), 6));
  Measured const wanted{window, side_for(seen, in_view)};
  measure({&wanted, 1});
  Tile const& laid_out = tile(window, wanted.side);
  std::vector<SurfaceId> const& casters = in_view.casters;
  draw_list_.clear();
  ReceiverJob in_front = add_view(seen, laid_out, casters, towards_sun);
  std::size_t const behind_view =
      draw_list_.add_view(view_behind(*seen.frame, laid_out.map, towards_sun, reach),
                          on_device_->geometry.scene_origin());
  std::vector<Range> surfaces;
  for (SurfaceId const id : interiors) surfaces.push_back(add_surfaces({&id, 1}));
  bool const transmits = any_transmits(casters);
  std::optional<ScheduleKeys> const keys = keys_of(window, casters);
  if (transmits) see_through(draw_list_, casters, towards_sun);
  if (keys) in_front.first_key = draw_list_.add_keys(keys->keys());

  egl::Current const current = device_.context.make_current();
  on_device_->geometry.upload(draw_list_);
  int const side = laid_out.side;
  if (transmits) {
    InteriorLuminance& interior =
        on_device_->interior_luminance.try_emplace(side, side).first->second;
    std::vector<LuminanceByKey> const sums =
        interior.sum(on_device_->geometry, {in_front, behind_view, surfaces});
    for (std::size_t i = 0; i < sums.size(); ++i) {
      answers[i] = sunlit_of(sums[i], keys ? &*keys : nullptr, seen, laid_out, cosine);
    }
  } else {
    Interior& interior = on_device_->interior.try_emplace(side, side).first->second;
    std::vector<std::uint64_t> const counts =
        interior.count(on_device_->geometry, {in_front, behind_view, surfaces});
    for (std::size_t i = 0; i < counts.size(); ++i) {
      answers[i] =
          sunlit_of({{{}, static_cast<double>(counts[i])}}, nullptr, seen, laid_out, cosine);
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
      faces_sun ? casters_.in_view(scene_, id, *seen.frame, towards_sun, 0.0).casters
                : std::vector<SurfaceId>();
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
