#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/transport.h"
#include "transport/mirrors.h"
#include "transport/sobol_points.h"

namespace gpu_shading {

// Directions about a normal with a density in proportion to the cosine; u and v are 0 .. 1.
glm::dvec3 cosine_direction(glm::dvec3 const& normal, double u, double v);

// Points of a polygon without its holes, spread by area.
class ReceiverPoints {
 public:
  explicit ReceiverPoints(Polygon const& polygon);

  // Without area, a receiver has no points.
  bool empty() const { return up_to_.empty(); }
  glm::dvec3 const& normal() const { return normal_; }
  glm::dvec3 at(double u, double v) const;

 private:
  std::vector<glm::dvec3> corners_;  // three for each triangle
  std::vector<double> up_to_;        // the share of the area up to the end of each triangle
  glm::dvec3 normal_{0.0};
};

// Where a path to the receiver was reflected.
struct KeptHit {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  // of the face that reflected
  // Irradiance of the receiver for an irradiance of 1 of this place, times the number of paths.
  double weight = 0.0;
  std::optional<SurfaceId> surface = std::nullopt;  // none: the ground
  int by_ground = 0;         // how many of the reflections up to the receiver are the ground's
  bool on_receiver = false;  // not yet reflected
};

// The part of light that the ground reflected so many times.
inline double& part_of(LightByGround& light, int by_ground) {
  return by_ground == 0 ? light.none : by_ground == 1 ? light.once : light.more;
}

struct ReversePaths {
  std::vector<KeptHit> hits;
  // As in Transported.
  LightByGround sky = {};
  double sky_direct = 0.0;
  std::size_t rays = 0;
};

// What paths meet.
struct TransportScene {
  Scene const& scene;
  RayScene const& rays;
  std::span<glm::dvec3 const> normals;  // by surface, as are the reflectances
  std::span<FaceReflectances const> reflectances;
  std::optional<ReflectingGround> ground;
  Mirrors const& mirrors;
};

// Dimensions of the points that trace_paths() takes: a place, and the first directions.
inline constexpr std::size_t path_bounces_by_sobol = 3;
inline constexpr std::size_t path_dimensions = 4 + 2 * path_bounces_by_sobol;

// A path for each point, from the receiver until it is absorbed or leaves the scene. After the
// first bounces, a path goes on with the probability of the reflectance.
ReversePaths trace_paths(TransportScene const& scene, SurfaceId receiver,
                         ReceiverPoints const& places, SobolPoints const& points,
                         std::uint32_t seed, RayConditions const& conditions);

}  // namespace gpu_shading
