#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "hidden/hidden_casters.h"

namespace gpu_shading::energyplus {

// A ray from a point of a surface that receives reflected solar radiation, and what it meets of
// the surfaces that EnergyPlus knows. Metres.
struct ReflectionRay {
  enum class Meets { sky, ground, surface };

  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0};  // of unit length
  Meets meets = Meets::sky;
  glm::dvec3 hit{0.0};  // unless it meets the sky
  double distance = std::numeric_limits<double>::infinity();
};

// The effect of hidden casters on a ray.
struct ReflectedShare {
  // What EnergyPlus itself counts for the ray has to be multiplied by this, 0 .. 1.
  double kept = 1.0;
  // Radiance that hidden casters reflect along the ray, times pi, over the irradiance of the
  // source: of the beam at normal incidence, or of the unobstructed sky on the horizontal.
  double shades = 0.0;
  // With the beam, the share of it that reaches the ground and comes back; with the sky, the share
  // of what an unobstructed ground reflects that comes back. To be counted instead of
  // EnergyPlus's own share; kept is then 0.
  double ground = 0.0;
};

// The effect of surfaces that are not in EnergyPlus's input (lean input, surroundings) on solar
// radiation that EnergyPlus's surfaces receive by reflection: they stop a part of it, and of what
// reaches other surfaces and the ground, and reflect themselves, diffusely.
// As in EnergyPlus's SolarReflectionManager, the mean of a surface's side decides about the sky,
// and the point that is hit about the beam, but a side of which less than a hundredth is in the sun
// at the hour's first timestep reflects nothing. Not for several threads at once.
class HiddenReflections {
 public:
  // The scene must be complete() and outlive this. Throws Error if a screen's texture cannot be
  // read.
  explicit HiddenReflections(SceneAssembly const& scene);

  // Whether there are hidden casters. Without them, nothing else may be called.
  bool any() const { return casters_.any(); }

  // The rays of the simulation, all of them.
  void set_rays(std::vector<ReflectionRay> rays);
  std::vector<ReflectionRay> const& rays() const { return rays_; }

  // The directions to the sun at an hour for which EnergyPlus computes reflections, of unit length.
  struct Sun {
    int hour = 1;                         // 1 .. 24, at whose first timestep schedules are read
    glm::dvec3 direction{0.0, 0.0, 1.0};  // above the horizon
    std::optional<glm::dvec3> at_first_timestep;  // nothing: below the horizon
  };

  // The share of each ray, in order, for the beam.
  std::vector<ReflectedShare> const& beam(Sun const& sun);

  // The same for a uniform sky, with schedules as at the first hour.
  std::vector<ReflectedShare> const& sky();

  // Transmittance of all hidden casters, 0 .. 1.
  double transmittance(Ray const& ray, int hour);

  // Schedules may have other values from now on: another day.
  void renew() {
    casters_.renew();
    moment_.reset();
  }

 private:
  using Layer = HiddenCasters::Layer;
  using RayPath = HiddenCasters::RayPath;

  void trace(int hour);
  void keep(glm::dvec3 const& to_sun);
  void reflect(Sun const& sun);
  ReflectedShare sky_share(ReflectionRay const& ray, RayPath const& path);
  bool lit(Layer const& layer, std::optional<glm::dvec3> const& to_sun);

  HiddenCasters casters_;
  std::vector<ReflectionRay> rays_;
  std::vector<RayPath> paths_;  // by ray, once traced
  std::vector<ReflectedShare> shares_;
  std::optional<int> moment_;  // the hour of the ways
  std::map<HiddenCasters::Side, bool> lit_;
};

}  // namespace gpu_shading::energyplus
