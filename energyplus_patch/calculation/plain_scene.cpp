#include "calculation/plain_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gpu_shading/error.h"
#include "scene/scene_assembly.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

void turn_over(Polygon& polygon) {
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  for (auto& hole : polygon.holes) std::reverse(hole.begin(), hole.end());
}

}  // namespace

SurfaceId PlainScene::add(Surface surface) {
  surfaces_.push_back(std::move(surface));
  return static_cast<SurfaceId>(surfaces_.size() - 1);
}

SurfaceId PlainScene::add_mirrored(SurfaceId original) {
  return add(mirrored(surfaces_.at(original)));
}

void PlainScene::start(Simulation /*simulation*/) {
  normals_.clear();
  for (auto const& surface : surfaces_) normals_.push_back(normal(surface.polygon));
  asked_.assign(surfaces_.size(), false);
  known_.clear();
  for (auto& renderer : renderers_) renderer.reset();
  renderer(Side::front);
}

Renderer& PlainScene::renderer(Side side) {
  auto& renderer = renderers_.at(static_cast<std::size_t>(side));
  if (!renderer) {
    Scene scene;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      auto surface = surfaces_[i];
      if (side == Side::back) turn_over(surface.polygon);
      scene.add(std::move(surface));
    }
    renderer.emplace(std::move(scene), options_);
  }
  return *renderer;
}

PlainScene::Side PlainScene::lit_side(SurfaceId surface) const {
  if (!renderers_.front()) throw Error("set_model() must come before questions");
  if (surface >= normals_.size()) {
    throw Error(fmt::format("surface {} was added after set_model()", surface));
  }
  return glm::dot(normals_[surface], to_vector(sun_)) >= 0.0 ? Side::front : Side::back;
}

PlainScene::Areas& PlainScene::known_areas() {
  constexpr std::size_t max_numbers = std::size_t{1} << 26U;  // 512 MiB
  if (known_.size() * normals_.size() > max_numbers) known_.clear();
  auto& areas = known_[{sun_.azimuth, sun_.altitude}];
  areas.resize(normals_.size(), std::numeric_limits<double>::quiet_NaN());
  return areas;
}

void PlainScene::render(Side side, Areas& areas) {
  std::vector<SurfaceId> wanted;
  for (SurfaceId id = 0; id < asked_.size(); ++id) {
    if (asked_[id] && std::isnan(areas[id]) && lit_side(id) == side) wanted.push_back(id);
  }
  auto const sunlit = renderer(side).projected_sunlit_areas(sun_, wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i) areas[wanted[i]] = sunlit[i].projected_area;
}

double PlainScene::projected_sunlit_area(SurfaceId receiver) {
  return projected_sunlit_areas({&receiver, 1}).front();
}

std::vector<double> PlainScene::projected_sunlit_areas(std::span<SurfaceId const> receivers) {
  std::array<bool, 2> render_side{};
  auto& areas = known_areas();
  for (auto const receiver : receivers) {
    auto const side = lit_side(receiver);
    asked_[receiver] = true;
    if (std::isnan(areas[receiver])) render_side.at(static_cast<std::size_t>(side)) = true;
  }
  for (auto const side : {Side::front, Side::back}) {
    if (render_side.at(static_cast<std::size_t>(side))) render(side, areas);
  }
  std::vector<double> answers;
  answers.reserve(receivers.size());
  for (auto const receiver : receivers) answers.push_back(areas[receiver]);
  return answers;
}

// Walls that the sun reaches from inside turn away from it if the window turns towards it.
std::vector<double> PlainScene::interior_areas(SurfaceId window,
                                               std::vector<SurfaceId> const& interiors) {
  auto const side = lit_side(window);
  for (auto const interior : interiors) lit_side(interior);
  if (is_sky_patch(sun_)) return std::vector<double>(interiors.size(), 0.0);
  std::vector<double> areas;
  areas.reserve(interiors.size());
  for (auto const& each : renderer(side).interior_sunlit_areas(sun_, window, interiors)) {
    areas.push_back(each.projected_area);
  }
  return areas;
}

std::string PlainScene::vendor() {
  auto const& front = renderers_.front();
  return front ? front->device().vendor : Renderer(Scene{}, options_).device().vendor;
}

}  // namespace gpu_shading::energyplus
