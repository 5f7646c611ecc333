#include "gpu_shading/transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/parallel.h"
#include "transport/receiver_light.h"

namespace gpu_shading {
namespace {

void require_share(double value, SurfaceId surface) {
  if (!(value >= 0.0 && value <= 1.0)) {
    throw Error(
        fmt::format("the reflectance of surface {} is {}; expected 0 to 1", surface, value));
  }
}

// FNV-1a.
std::uint32_t seed_of(std::string_view name) {
  constexpr std::uint32_t offset = 2166136261U;
  constexpr std::uint32_t prime = 16777619U;
  std::uint32_t hash = offset;
  for (unsigned char const letter : name) hash = (hash ^ letter) * prime;
  return hash;
}

}  // namespace

Transport::Transport(Scene const& scene, RayScene const& rays,
                     std::vector<FaceReflectances> reflectances,
                     std::optional<ReflectingGround> ground)
    : scene_(scene), rays_(rays), reflectances_(std::move(reflectances)), ground_(ground) {
  if (reflectances_.size() != scene.size()) {
    throw Error(fmt::format("there are {} reflectances; expected {}, one for each surface",
                            reflectances_.size(), scene.size()));
  }
  normals_.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    require_share(reflectances_[id].front, id);
    require_share(reflectances_[id].back, id);
    require_share(reflectances_[id].specular, id);
    require_share(reflectances_[id].grazing, id);
    require_share(
        std::max(reflectances_[id].front, reflectances_[id].back) + reflectances_[id].specular, id);
    normals_.push_back(normal(scene[id].polygon));
  }
  mirrors_ = std::make_shared<Mirrors const>(scene, normals_, reflectances_);
}

Transported Transport::to(SurfaceId receiver, TransportRequest const& request,
                          RayConditions const& conditions, std::uint32_t seed) const {
  TransportScene const scene{scene_, rays_, normals_, reflectances_, ground_, *mirrors_};
  SolarHours const year(request);
  return light_on({scene, request, year, conditions}, receiver, seed);
}

std::vector<Transported> Transport::to(std::span<SurfaceId const> receivers,
                                       TransportRequest const& request,
                                       RayConditions const& conditions) const {
  TransportScene const scene{scene_, rays_, normals_, reflectances_, ground_, *mirrors_};
  SolarHours const year(request);
  std::vector<std::optional<Transported>> found(receivers.size());
  for_each_index(receivers.size(), [&](std::size_t i) {
    auto const seed = seed_of(scene_[receivers[i]].name);
    found[i] = light_on({scene, request, year, conditions}, receivers[i], seed);
  });
  std::vector<Transported> lights;
  lights.reserve(found.size());
  for (auto& light : found) lights.push_back(std::move(*light));
  return lights;
}

}  // namespace gpu_shading
