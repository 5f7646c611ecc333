#include "backends/opengl/raster/gl_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/limits.h"
#include "backends/opengl/raster/crowd_masks.h"
#include "geometry/triangulation.h"
#include "gpu_shading/error.h"
#include "scene/casters.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

LuminanceSum fastest_sum(DeviceInfo const& device) {
  return device.software ? LuminanceSum::readback : LuminanceSum::compute;
}

// The limits of the public header. In software, the device's memory should fit in the CPU's cache:
// with 4 MiB and three submissions under way, 500 panes over 20 receivers took 10 to 25 % more CPU
// time.
Bounds bounds_of(GlSettings const& settings, DeviceInfo const& device) {
  constexpr std::size_t mib = std::size_t{1} << 20U;
  gl::Limits const limits = gl::query_limits();
  Bounds bounds;
  bounds.in_flight = device.software ? 1 : gl::StorageBuffer::max_in_flight;
  bounds.target = (device.software ? 1 : 32) * mib;
  bounds.all_targets = (device.software ? 64 : 512) * mib;
  bounds.layers = limits.layers_in_vertex_stage ? limits.max_layers : 1;
  if (settings.max_layers > 0) bounds.layers = std::min(bounds.layers, settings.max_layers);
  return bounds;
}

Kind kind_of(ReceiverView const& view, bool scheduled) {
  if (!view.transmits) return view.through ? Kind::interior : Kind::opaque;
  if (view.through) return Kind::shaded_interior;
  return scheduled ? Kind::scheduled : Kind::unscheduled;
}

LuminanceSums sums_of(LuminanceByKey const& by_key, ScheduleKeys const* keys) {
  LuminanceSums sums;
  for (auto const& [key, sum] : by_key) {
    std::vector<std::pair<int, int>> powers;
    if (keys != nullptr) powers = keys->powers(key);
    if (powers.empty()) {
      sums.unscheduled = sum;
    } else {
      sums.scheduled.push_back({std::move(powers), sum});
    }
  }
  return sums;
}

}  // namespace

struct GlBackend::OnDevice {
  OnDevice(BackendInput const& input, Bounds const& bounds, LuminanceSum how)
      : geometry(input.scene, input.meshes, input.transmission),
        submissions(geometry, input.transmission, bounds, how, input.statistics) {}

  Geometry geometry;
  Submissions submissions;
  bool takes_crowds = false;
  std::optional<CrowdMasks> crowds;  // once there is one
};

GlBackend::GlBackend(egl::Device device, BackendInput const& input, GlSettings const& settings)
    : device_(std::move(device)), scene_(input.scene), transmission_(input.transmission) {
  egl::Current const current = device_.context.make_current();
  on_device_ = std::make_unique<OnDevice>(input, bounds_of(settings, device_.info),
                                          settings.sum.value_or(fastest_sum(device_.info)));
  bool const wanted = settings.crowds.value_or(!device_.info.software);
  on_device_->takes_crowds =
      wanted && input.transmission.all_opaque() && CrowdMasks::fit(input.meshes);
}

std::optional<std::size_t> GlBackend::few_casters(bool interiors) const {
  constexpr std::size_t few = 500;
  if (interiors || !on_device_->takes_crowds) return std::nullopt;
  return few;
}

GlBackend::~GlBackend() {
  try {
    egl::Current const current = device_.context.make_current();
    on_device_.reset();
  } catch (DeviceError const&) {
    // Objects of a lost device are not deleted, because without a context that could delete someone
    // else's.
    static_cast<void>(on_device_.release());
  }
}

void GlBackend::add(std::vector<ReceiverView> views) {
  if (views.empty()) return;
  egl::Current const current = device_.context.make_current();
  for (ReceiverView const& view : views) {
    if (view.crowd != nullptr) {
      cover(view);
    } else {
      draw(view);
    }
  }
}

void GlBackend::cover(ReceiverView const& view) {
  auto& crowds = on_device_->crowds;
  if (!crowds) {
    crowds.emplace(scene_, triangulate_all(scene_), *view.crowd, !device_.info.software);
  }
  drawn_.push_back({view.tile, std::nullopt, crowds->add(view), true});
}

void GlBackend::draw(ReceiverView const& view) {
  measure(*view.tile);
  Drawn drawn{view.tile, keys(view), 0};
  ScheduleKeys const* const keys = drawn.keys ? &*drawn.keys : nullptr;
  drawn.view = on_device_->submissions.add(
      kind_of(view, keys != nullptr), view.tile->side, view.through ? view.interiors.size() : 1,
      [&](DrawList& list, int layer) { gather(list, layer, view, keys); });
  drawn_.push_back(std::move(drawn));
}

void GlBackend::measure(Tile const& tile) {
  if (receiver_pixels_.contains(&tile) || measured_.contains(&tile)) return;
  std::size_t const view = on_device_->submissions.add(
      Kind::opaque, tile.side, 1,
      [&](DrawList& list, int layer) { list.add_tile(tile.triangles, layer); });
  measured_.emplace(&tile, view);
}

std::optional<ScheduleKeys> GlBackend::keys(ReceiverView const& view) const {
  std::vector<int> passed;
  for (SurfaceId const caster : view.casters) {
    int const schedule = transmission_.schedule(caster);
    if (schedule != Shade::unscheduled) passed.push_back(schedule);
  }
  if (passed.empty()) return std::nullopt;
  auto keys = ScheduleKeys::make(passed, static_cast<int>(transmission_.schedules().size()));
  if (!keys) {
    std::sort(passed.begin(), passed.end());
    auto const distinct = std::unique(passed.begin(), passed.end()) - passed.begin();
    throw Error(
        fmt::format("surface '{}' sees the sun through {} shades with {} different transmittance "
                    "schedules, more than can be counted separately; let shades share schedules",
                    scene_[view.receiver].name, passed.size(), distinct));
  }
  return keys;
}

void GlBackend::gather(DrawList& list, int layer, ReceiverView const& view,
                       ScheduleKeys const* keys) {
  list.add_tile(view.tile->triangles, layer);
  if (!view.casters.empty()) gather_casters(list, layer, view, keys);
  if (view.through) gather_interiors(list, layer, view);
}

void GlBackend::gather_casters(DrawList& list, int layer, ReceiverView const& view,
                               ScheduleKeys const* keys) {
  Geometry const& geometry = on_device_->geometry;
  glm::ivec4 numbers(layer, -1, 0, 0);
  DirectionTables* tables = nullptr;
  if (view.transmits) {
    tables = &list.tables(view.towards_sun, scene_.size());
    if (keys != nullptr) numbers.y = list.add_keys(keys->keys());
    numbers.z = static_cast<int>(tables->first_shade);
    numbers.w = static_cast<int>((list.directions().size() - 1) * geometry.screens().count());
  }
  std::uint32_t const record =
      list.add_view(view_in_front(*view.frame, view.tile->map, view.towards_sun),
                    geometry.scene_origin(), numbers);
  std::size_t const begin = list.begin_surfaces();
  for (SurfaceId const id : view.casters) {
    if (!transmission_.is_flat(id)) continue;
    list.add_triangles(geometry.triangles(id));
    if (tables == nullptr || !transmission_.transmits(id)) continue;
    std::size_t const place = tables->first_shade + id;
    if (!list.knows_shade(place)) {
      list.set_shade(place, transmission_.shade(id, view.towards_sun));
    }
  }
  list.add_caster_draw(list.end_surfaces(begin), record);
  if (tables == nullptr) return;
  geometry.crowns().add_to(list, *tables, record,
                           transmission_.crowns_among(view.casters, view.towards_sun));
  std::vector<int> const screens = transmission_.screens_among(view.casters);
  if (screens.empty()) return;
  geometry.screens().add_to(list, *tables, record, screens, view.pixel_area());
}

double GlBackend::reach(ReceiverView const& view) const {
  double farthest = clearance;
  for (SurfaceId const id : view.interiors) {
    for (glm::dvec3 const& vertex : scene_[id].polygon.outline) {
      farthest = std::max(farthest, -glm::dot(view.frame->normal, vertex - view.frame->origin));
    }
  }
  return 1.01 * farthest;  // a surface at the far end is not nearer than nothing
}

void GlBackend::gather_interiors(DrawList& list, int layer, ReceiverView const& view) {
  Geometry const& geometry = on_device_->geometry;
  View const behind = view_behind(*view.frame, view.tile->map, view.towards_sun, reach(view));
  int identity = 0;
  for (SurfaceId const id : view.interiors) {
    std::uint32_t const record =
        list.add_view(behind, geometry.scene_origin(), glm::ivec4(layer, ++identity, 0, 0));
    std::size_t const begin = list.begin_surfaces();
    list.add_triangles(geometry.triangles(id));
    list.add_interior_draw(list.end_surfaces(begin), record);
  }
}

std::vector<ViewSums> GlBackend::finish() {
  std::vector<ViewSums> sums(drawn_.size());
  if (drawn_.empty()) return sums;
  egl::Current const current = device_.context.make_current();
  Submissions& submissions = on_device_->submissions;
  submissions.finish();
  auto& crowds = on_device_->crowds;
  if (crowds) crowds->finish();
  for (auto const& [tile, view] : measured_) {
    double const pixels = submissions.sums(view).front().begin()->second;
    if (pixels > 0.0) receiver_pixels_.emplace(tile, static_cast<std::uint64_t>(pixels));
  }
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    Drawn const& drawn = drawn_[i];
    if (drawn.crowd) {
      auto const [own, lit] = crowds->samples(drawn.view);
      auto const pixels = static_cast<double>(drawn.tile->counted_pixels);
      sums[i].receiver_pixels = own > 0 ? drawn.tile->counted_pixels : 0;
      sums[i].parts.push_back({lit * pixels / std::max(own, 1U), {}});
      continue;
    }
    auto const known = receiver_pixels_.find(drawn.tile);
    if (known != receiver_pixels_.end()) sums[i].receiver_pixels = known->second;
    ScheduleKeys const* const keys = drawn.keys ? &*drawn.keys : nullptr;
    for (LuminanceByKey const& part : submissions.sums(drawn.view)) {
      sums[i].parts.push_back(sums_of(part, keys));
    }
  }
  drawn_.clear();
  measured_.clear();
  submissions.clear();
  if (crowds) crowds->clear();
  return sums;
}

void GlBackend::forget() {
  drawn_.clear();
  measured_.clear();
  egl::Current const current = device_.context.make_current();
  on_device_->submissions.clear();
  if (on_device_->crowds) on_device_->crowds->clear();
}

}  // namespace gpu_shading
