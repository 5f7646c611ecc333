#include "session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <numeric>

#include "gpu_shading/error.h"
#include "session/listing.h"
#include "session/report.h"
#include "session/shading_rule.h"

namespace gpu_shading::energyplus {
namespace {

std::uint64_t hash_of(SurfaceId window, std::vector<SurfaceId> const& interiors) {
  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325;
  auto const mix = [&](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3; };
  mix(window);
  for (auto const id : interiors) mix(id);
  return hash;
}

// Leaves the `limit` largest as they are and sets the others to 0; EnergyPlus spreads the beam that
// no surface takes as diffuse.
void keep_largest(std::vector<float>& areas, std::size_t limit) {
  auto const lit = static_cast<std::size_t>(
      std::count_if(areas.begin(), areas.end(), [](float area) { return area > 0.0F; }));
  if (lit <= limit) return;
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  for (std::size_t i = limit; i < order.size(); ++i) areas[order[i]] = 0.0F;
}

}  // namespace

SurfaceId Session::add(Surface surface) {
  if (surface.casting != Casting::never) surface.casting = model_.shading.casting(surface.name);
  return scene_.add(std::move(surface));
}

std::vector<SurfaceId> Session::shading_surfaces() const {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene_.size(); ++id) {
    if (model_.shading.shading_surfaces.contains(scene_[id].name)) ids.push_back(id);
  }
  return ids;
}

void Session::start(Messages messages) {
  messages_ = std::move(messages);
  surfaces_ = scene_.size();
  add_walls_without_openings();
  std::vector<std::string> names;
  names.reserve(scene_.size());
  for (SurfaceId id = 0; id < scene_.size(); ++id) names.push_back(scene_[id].name);

  auto const& input = model_.shading;
  wanted_.assign(surfaces_, true);
  is_receiver_.assign(surfaces_, false);
  for (SurfaceId id = 0; id < surfaces_; ++id) {
    wanted_[id] = !input.shading_surfaces.contains(names[id]) || input.wants(names[id]);
  }
  if (char const* const listing = std::getenv(listing_variable)) {
    std::ofstream(listing) << list_surfaces(scene_, input, wanted_);
    std::_Exit(EXIT_SUCCESS);
  }
  scene_.set_rule(make_shading_rule(input, names));
  answers_ = Answers(surfaces_);

  auto const& options = model_.options;
  if (options.report) prepare_report(*options.report);
  renderer_.emplace(std::move(scene_), RendererOptions{options.device, options.resolution});
  if (renderer_->device().software && options.device.kind == DeviceChoice::Kind::automatic) {
    if (options.mode == Mode::require) {
      throw DeviceError(
          fmt::format("--gpu-shading=require: no GPU can be had, only {}; see gpu_shading devices",
                      renderer_->device().renderer));
    }
    messages_.warning(
        fmt::format("no GPU can be had, shading is rendered in software ({}); see gpu_shading "
                    "devices",
                    renderer_->device().renderer));
  } else if (renderer_->device().software && options.mode == Mode::require) {
    throw DeviceError(fmt::format("--gpu-shading=require: the device chosen, {}, is not a GPU",
                                  renderer_->device().renderer));
  }
  describe_surfaces();
}

void Session::add_walls_without_openings() {
  for (SurfaceId id = 0; id < surfaces_; ++id) {
    auto const& wall = scene_[id];
    if (wall.polygon.holes.empty() || wall.casting == Casting::never) continue;
    scene_.add({without_openings(wall.name), {wall.polygon.outline, {}}, wall.casting});
  }
}

void Session::describe_surfaces() {
  std::size_t scheduled = 0;
  for (auto const& [name, surface] : model_.shading.shading_surfaces) {
    if (surface.transmittance_schedule.empty()) continue;
    if (scheduled++ == 0) {
      messages_.eio(
          "! <GPU Shading Surface>, Surface Name, Caster Type, Transmittance Schedule Name\n");
    }
    messages_.eio(fmt::format("GPU Shading Surface,{},Opaque (schedule not applied),{}\n", name,
                              surface.transmittance_schedule));
  }
  if (scheduled > 0) {
    messages_.warning(
        fmt::format("{} shading surfaces have a Transmittance Schedule Name, which is not applied "
                    "yet: they are opaque",
                    scheduled));
  }
}

void Session::render(Answers::Direction& direction, SurfaceId asked) {
  std::vector<SurfaceId> batch;
  for (auto const id : receivers_) {
    if (!Answers::known(direction.projected_area[id])) batch.push_back(id);
  }
  if (std::find(batch.begin(), batch.end(), asked) == batch.end()) batch.push_back(asked);
  auto const sunlit = renderer_->projected_sunlit_areas(direction.sun, batch);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    direction.projected_area[batch[i]] = static_cast<float>(sunlit[i].projected_area);
  }
}

float Session::projected_sunlit_area(SurfaceId receiver) {
  if (!renderer_ || receiver >= surfaces_) {
    throw Error(fmt::format("EnergyPlus asks for surface {} of {}", receiver, surfaces_));
  }
  if (!is_wanted(receiver)) {
    auto const& polygon = renderer_->scene()[receiver].polygon;
    double const cosine = glm::dot(normal(polygon), to_vector(sun_));
    return static_cast<float>(area(polygon) * std::max(cosine, 0.0));
  }
  auto& direction = answers_.at(sun_);
  if (!Answers::known(direction.projected_area[receiver])) render(direction, receiver);
  if (!is_receiver_[receiver]) {
    is_receiver_[receiver] = true;
    receivers_.push_back(receiver);
  }
  return direction.projected_area[receiver];
}

std::vector<float> Session::interior_areas(SurfaceId window,
                                           std::vector<SurfaceId> const& interiors) {
  if (!renderer_)
    throw Error("EnergyPlus asks for interior areas before its surfaces are complete");
  auto& kept = answers_.at(sun_).interior[hash_of(window, interiors)];
  if (kept.size() != interiors.size()) {
    auto const areas = renderer_->interior_projected_sunlit_areas(sun_, window, interiors);
    kept.assign(areas.begin(), areas.end());
    keep_largest(kept, max_back_surfaces);
  }
  return kept;
}

void Session::finish() {
  if (finished_ || !renderer_) return;
  finished_ = true;
  auto const& device = renderer_->device();
  auto const& did = renderer_->statistics();
  messages_.remark(fmt::format(
      "shading rendered by {} ({}), {} x {} pixels: {} receivers, {} casters, {} directions, {} "
      "views drawn, {} clear, {:.2f} s",
      device.renderer, device.version, model_.options.resolution, model_.options.resolution,
      receivers_.size(), surfaces_, did.directions, did.receivers_drawn, did.receivers_clear,
      did.seconds));
  if (model_.options.report) write_report(*model_.options.report, *renderer_, receivers_, answers_);
}

}  // namespace gpu_shading::energyplus
