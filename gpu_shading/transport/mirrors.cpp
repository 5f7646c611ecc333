#include "transport/mirrors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "gpu_shading/rays.h"

namespace gpu_shading {

std::uint64_t normal_key(glm::dvec3 const& normal) {
  constexpr double steps = 500.0;
  constexpr int axis_bits = 16;
  constexpr double middle = 1U << (axis_bits - 1);
  std::uint64_t bits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    auto const step = std::lround(normal[axis] * steps + middle);
    bits = bits << axis_bits | static_cast<std::uint64_t>(step);
  }
  return bits;
}

double mirror_reflectance(FaceReflectances const& faces, double diffuse, double cosine) {
  if (faces.specular <= 0.0) return 0.0;
  double const rise = std::pow(1.0 - std::abs(cosine), 5.0);
  return std::min(std::lerp(faces.specular, faces.grazing, rise), 1.0 - diffuse);
}

Mirrors::Mirrors(Scene const& scene, std::span<glm::dvec3 const> normals,
                 std::vector<FaceReflectances> reflectances)
    : reflectances_(std::move(reflectances)), orientation_of_(scene.size()) {
  std::unordered_map<std::uint64_t, std::size_t> known;
  std::vector<SurfaceId> mirrors;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    double const at_normal = reflectances_[id].specular;
    if (at_normal <= 0.0) continue;
    mirrors.push_back(id);
    auto const key = std::min(normal_key(normals[id]), normal_key(-normals[id]));
    auto const [entry, added] = known.try_emplace(key, orientations_.size());
    if (added) orientations_.push_back({normals[id], 0.0});
    orientations_[entry->second].extent += at_normal * area(scene[id].polygon);
    orientation_of_[id] = entry->second;
  }
  if (!mirrors.empty()) {
    alone_.emplace(scene, RayOptions{RayFaces::both, ScreenDetail::automatic, mirrors});
  }
}

std::vector<LightDirection> Mirrors::images(glm::dvec3 const& sun) const {
  std::vector<LightDirection> images;
  images.reserve(orientations_.size());
  for (auto const& [normal, extent] : orientations_) {
    images.push_back({sun - 2.0 * glm::dot(sun, normal) * normal, extent, true});
  }
  return images;
}

double Mirrors::reflected(RayScene const& rays, RayConditions const& conditions, Ray ray,
                          std::size_t image, glm::dvec3 const& sun, std::size_t& count) const {
  // Most rays miss, and there are far fewer mirrors than surfaces.
  ++count;
  auto const hit = alone_->nearest_opaque(ray, conditions);
  if (!hit || orientation_of_[hit->surface] != image) return 0.0;
  ray.length = hit->distance;
  double passed = rays.transmittance(ray, conditions);
  ++count;
  if (passed <= 0.0) return 0.0;
  Ray onwards{ray.origin + hit->distance * ray.direction, sun};
  onwards.from = hit->surface;
  auto from_mirror = conditions;
  from_mirror.receiver = std::nullopt;
  ++count;
  passed *= rays.transmittance(onwards, from_mirror);
  auto const& faces = reflectances_[hit->surface];
  return passed * mirror_reflectance(faces, std::max(faces.front, faces.back),
                                     glm::dot(orientations_[image].normal, sun));
}

}  // namespace gpu_shading
