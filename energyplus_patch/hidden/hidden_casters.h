#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gpu_shading/rays.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Values of schedules at the hours of a day, 1 .. 24, at their first timestep, when EnergyPlus
// reads those of shading surfaces for rays. Read once each.
class HourShares {
 public:
  struct Shares {
    std::vector<double> factors;
    std::vector<double> deployments;

    bool operator==(Shares const&) const = default;
    RayConditions conditions() const { return {.factors = factors, .deployments = deployments}; }
  };

  // The optics must outlive this.
  explicit HourShares(ShadeOptics const& optics) : optics_(optics) {}

  // Hours out of range are taken as the nearest. Holds until renew().
  Shares const& at(int hour);

  // Schedules may have other values from now on: another day.
  void renew() { known_ = {}; }

 private:
  static constexpr std::size_t hours = 24;
  ShadeOptics const& optics_;
  std::array<std::optional<Shares>, hours> known_;
};

// Obstructions of EnergyPlus's rays of daylighting that are not in its input: lean input and
// surroundings. Not for several threads at once.
class HiddenObstructions {
 public:
  // The scene must be complete() and outlive this. Throws Error if a screen's texture cannot be
  // read.
  explicit HiddenObstructions(SceneAssembly const& scene);

  // Transmittance of all obstructions along a ray, 0 .. 1. `hour`: 1 .. 24, at whose
  // first timestep EnergyPlus reads the schedules of shading surfaces for daylighting.
  double transmittance(Ray const& ray, int hour);

  // Schedules may have other values from now on: another day.
  void renew() { shares_.renew(); }

 private:
  std::optional<RayScene> rays_;  // none: there is no obstruction
  HourShares shares_;
};

// A direction to the sky, and the share that it has of the irradiance on the horizontal.
struct SkyShare {
  glm::dvec3 direction;
  double share;
};

// Those that EnergyPlus sees from the ground, for solar reflections and for daylighting.
std::vector<SkyShare> const& sky_patches_from_ground();

// The casters that are not in EnergyPlus's input (lean input, surroundings), as they stop and
// reflect radiation. A caster reflects its diffuse reflectance, but not more than it does not let
// pass; a perforated sheet reflects with the solid share of its area. Not for several threads at
// once.
class HiddenCasters {
 public:
  // The scene must be complete() and outlive this. `samples`: points of a surface from which the
  // sky is looked at. Throws Error if a screen's texture cannot be read.
  HiddenCasters(SceneAssembly const& scene, ShadeOptics::Radiation radiation, std::size_t samples);

  // Without any, nothing else may be called.
  bool any() const { return hidden_.has_value(); }

  // A caster on a ray's way.
  struct Layer {
    SurfaceId surface = 0;
    glm::dvec3 at{0.0};
    glm::dvec3 normal{0.0};    // on the side that the ray meets
    double reflectance = 0.0;  // times the transmittance on the way back
  };
  struct RayPath {
    std::vector<Layer> layers;  // that reflect, nearest first
    double passed = 1.0;        // of all casters
    bool free = true;           // it meets none
  };
  std::vector<RayPath> paths(std::span<Ray const> rays) const;
  RayPath path(Ray const& ray) const;

  // Reads the schedules of an hour, 1 .. 24, at its first timestep. Returns whether they have other
  // values than before.
  bool set_hour(int hour);

  // Schedules may have other values from now on: another day.
  void renew() { by_hour_.renew(); }

  // Transmittance of all casters, 0 .. 1: hidden ones only, or EnergyPlus's own surfaces too.
  double transmittance(Ray const& ray) const { return hidden_->transmittance(ray, conditions()); }
  double transmittance_of_all(Ray const& ray) const {
    return all_->transmittance(ray, conditions());
  }
  std::vector<double> transmittances(std::span<Ray const> rays) const;
  std::vector<double> transmittances_of_all(std::span<Ray const> rays) const;

  // The irradiance from a uniform sky on the side of a caster that a ray meets, over that on the
  // horizontal without obstructions, as the mean over the side, with schedules as at the first
  // hour.
  double sky_view(Layer const& layer);

  // Changes when the schedules of the first hour do.
  unsigned sky_version();

  // By surface and whether it is the side of its normal.
  using Side = std::pair<SurfaceId, bool>;
  Side side_of(Layer const& layer) const;

  // Points spread over a surface.
  std::vector<glm::dvec3> const& samples(SurfaceId surface);

 private:
  RayConditions conditions() const { return shares_.conditions(); }
  RayPath path_of(Ray const& ray, std::vector<RayLayer> const& layers) const;
  double reflectance(SurfaceId surface, double transmittance) const;

  SceneAssembly const& scene_;
  ShadeOptics::Radiation radiation_;
  std::size_t sample_count_;
  Scene surfaces_;
  std::optional<RayScene> hidden_;  // none: there is no hidden caster
  std::optional<RayScene> all_;
  HourShares by_hour_;
  HourShares::Shares shares_;  // of the hour
  std::map<Side, double> sky_views_;
  HourShares::Shares sky_shares_;  // of the first hour
  unsigned sky_version_ = 0;
  std::map<SurfaceId, std::vector<glm::dvec3>> samples_;
};

}  // namespace gpu_shading::energyplus
