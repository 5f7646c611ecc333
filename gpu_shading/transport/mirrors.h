#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/transport.h"

namespace gpu_shading {

// Equal for normals that are alike.
std::uint64_t normal_key(glm::dvec3 const& normal);

// Where a beam comes from.
struct LightDirection {
  glm::dvec3 towards{0.0};
  double share = 1.0;      // of the rays, in proportion
  bool by_mirror = false;  // straight light on the receiver itself is no reflected light
};

// What a face reflects as a mirror, by the cosine of the angle of incidence (Schlick, "An
// Inexpensive BRDF Model for Physically-based Rendering", 1994). `diffuse`: of that face.
double mirror_reflectance(FaceReflectances const& faces, double diffuse, double cosine);

// The sun in the plane mirrors of a scene, by one of them.
class Mirrors {
 public:
  // By surface of the scene.
  Mirrors(Scene const& scene, std::span<glm::dvec3 const> normals,
          std::vector<FaceReflectances> reflectances);

  bool empty() const { return orientations_.empty(); }

  // The sun's image in the mirrors of each orientation.
  std::vector<LightDirection> images(glm::dvec3 const& sun) const;

  // What reaches a ray's origin of a beam from the sun, by a mirror of the orientation of the image
  // that the ray leads to. Adds up the rays that it takes.
  double reflected(RayScene const& rays, RayConditions const& conditions, Ray ray,
                   std::size_t image, glm::dvec3 const& sun, std::size_t& count) const;

 private:
  struct Orientation {
    glm::dvec3 normal;  // or its opposite
    double extent;      // area times reflectance
  };

  std::vector<FaceReflectances> reflectances_;
  std::vector<Orientation> orientations_;
  std::vector<std::size_t> orientation_of_;  // by surface
  std::optional<RayScene> alone_;
};

}  // namespace gpu_shading
