#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>

#include "hidden/hidden_casters.h"

namespace gpu_shading::energyplus {

// The effect of surfaces that are not in EnergyPlus's input (lean input, surroundings) on light
// that EnergyPlus's daylighting receives by reflection, from the surfaces that its rays meet and
// from the ground. As in EnergyPlus, the mean of a surface's side decides about the sky, and the
// point that is hit about the sun. Hours are 1 .. 24; schedules are read at their first timestep.
// Not for several threads at once.
class HiddenLuminance {
 public:
  // The scene must be complete() and outlive this. Throws Error if a screen's texture cannot be
  // read.
  explicit HiddenLuminance(SceneAssembly const& scene);

  // Without hidden casters, nothing else may be called.
  bool any() const { return casters_.any(); }

  // Whether a ray meets a hidden caster.
  bool meets(Ray const& ray);

  // Hidden casters along a ray.
  struct View {
    double passed = 1.0;  // of what is behind them
    // Luminance, cd/m2, over the illuminance of the source, lux: of the sun at normal incidence,
    // and of the unobstructed uniform sky on the horizontal.
    double sun = 0.0;
    double sky = 0.0;
  };
  View view(Ray const& ray, int hour, glm::dvec3 const& to_sun);

  // Transmittance of all hidden casters, 0 .. 1.
  double transmittance(Ray const& ray, int hour);

  // The share of a uniform sky's illuminance that a point of the ground receives past all
  // obstructions, with schedules as at the first hour; nothing if hidden casters take none of it.
  std::optional<double> sky_on_ground(glm::dvec3 const& point);

  // Schedules may have other values from now on: another day.
  void renew();

 private:
  struct Hash {
    std::size_t operator()(std::array<double, 3> const& point) const noexcept;
  };
  void set_hour(int hour);
  HiddenCasters::RayPath const& path(Ray const& ray);
  std::optional<double> seen_sky(glm::dvec3 const& point) const;

  HiddenCasters casters_;
  // By point of the ground: EnergyPlus asks for the same from day to day.
  std::unordered_map<std::array<double, 3>, std::optional<double>, Hash> skies_;
  unsigned skies_version_ = 0;
  Ray last_;
  std::optional<HiddenCasters::RayPath> last_path_;
};

}  // namespace gpu_shading::energyplus
