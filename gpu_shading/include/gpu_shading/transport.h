#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/rays.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_position.h"

namespace gpu_shading {

class Mirrors;

// Reflectances of a surface's faces, 0 .. 1; the front is the side that the normal points to. For a
// perforated sheet: of its solid part.
struct FaceReflectances {
  double front = 0.0;  // diffuse (Lambertian)
  double back = 0.0;
  bool is_ground = false;  // terrain: its reflections count as the ground's
  // Of both faces as mirrors, at normal incidence, not more than what the diffuse ones leave. With
  // the angle it rises to `grazing` as by Schlick (1994). The sun reaches receivers, and whatever
  // reflects diffusely, by way of one mirror; surroundings and the sky by any number.
  double specular = 0.0;
  double grazing = 1.0;
};

// A horizontal plane without end, which reflects diffusely.
struct ReflectingGround {
  double height = 0.0;       // z, m
  double reflectance = 0.2;  // 0 .. 1
};

// The sun in one of the hours for which an answer is wanted.
struct TransportHour {
  HourDirection sun;
  double beam = 0.0;     // direct normal irradiance, W/m2
  double diffuse = 0.0;  // of the sky on level ground, W/m2
};

struct TransportRequest {
  double latitude = 0.0;  // radians
  // Errors are relative to the light of these hours, each with its own weight; those with the sun
  // below the horizon are left out. Their suns should be between those of a SunTable, as a year's
  // are: hours at the same hour angles every day may all be on its grid.
  std::span<TransportHour const> hours;
  // Wanted root-mean-square error of hourly values, weighted by energy, and error of their sum, of
  // the larger of the receiver's light and `floor` times that of a receiver without any shade.
  double hourly = 0.02;
  double annual = 0.005;
  double floor = 0.1;
  // Unit vectors to other lights, whose beams are wanted, too: the patches of a sky.
  std::span<glm::dvec3 const> lights = {};
  std::size_t most_rays = 1'500'000;  // after which the answer is as it is; the errors say so
};

// Values of suns on a grid of declination and hour angle, which holds every sun of a latitude.
class SunTable {
 public:
  // `declinations` between the solstices, both included; `step` of the hour angle, radians.
  SunTable(double latitude, int declinations, double step);

  // Unit vectors to the suns of the grid that are needed: those above the horizon and their
  // neighbours, which are lifted to half a degree above it.
  std::vector<glm::dvec3> const& suns() const { return suns_; }

  // For bilinear interpolation: suns by their position in suns(), with shares that add up to 1 or,
  // beside suns that are not needed, less. The sun is clamped to the grid.
  struct Corner {
    std::size_t sun = 0;
    double share = 0.0;
  };
  std::array<Corner, 4> around(HourDirection sun) const;

  // Bilinear. `values`: one for each of suns().
  double at(std::span<double const> values, HourDirection sun) const;

 private:
  double first_hour_ = 0.0;
  double hour_step_ = 0.0;
  double declination_step_ = 0.0;
  int declinations_ = 0;
  int hours_ = 0;
  std::vector<int> index_;  // of a sun by declination, then hour; -1: not needed
  std::vector<glm::dvec3> suns_;
};

// Irradiance, W/m2, by how many of the reflections on light's path are the ground's.
struct LightByGround {
  double none = 0.0;  // by shades, neighbours and the building alone
  double once = 0.0;
  double more = 0.0;

  double sum() const { return none + once + more; }
  // The sum with another reflectance of the ground. `ratio`: of that to the traced one, 0 or more.
  // Paths that the ground reflects more than twice count as if it did so twice.
  double at(double ratio) const { return none + ratio * (once + ratio * more); }

  LightByGround& operator+=(LightByGround const& other) {
    none += other.none;
    once += other.once;
    more += other.more;
    return *this;
  }
  friend LightByGround operator*(double factor, LightByGround const& light) {
    return {factor * light.none, factor * light.once, factor * light.more};
  }
};

// Irradiance of a receiver by paths with at least one reflection.
struct Transported {
  SunTable table;
  // For a beam of 1 W/m2 (normal) from each sun of the table.
  std::vector<LightByGround> beam = {};
  // The same from each of TransportRequest::lights.
  std::vector<LightByGround> lights = {};
  // For a uniform sky that gives 1 W/m2 to level ground in the open: by reflections, and straight.
  LightByGround sky = {};
  double sky_direct = 0.0;
  // Measured, relative as TransportRequest says: noise of the hours and of their sum, and the
  // errors of both by interpolation between suns (of hours: one standard error above what some suns
  // show). Errors of suns close to one another have the same sign.
  double noise = 0.0;
  double annual_noise = 0.0;
  double interpolation = 0.0;
  double annual_interpolation = 0.0;
  std::size_t rays = 0;

  // For a beam of 1 W/m2 from any sun of the table's latitude: bilinear.
  LightByGround beam_at(HourDirection sun) const;
};

// Light by way of reflections of any number, from the sun or the sky. Objects are
// immutable: any number of threads may ask one at the same time, and answers do not depend on how
// many do.
//
// Paths are traced from the receiver, by scrambled Sobol points (Owen 1995; Laine and Karras 2011;
// Joe and Kuo 2008). Every place where one is reflected diffusely is kept with its weight. For each
// sun, some of these are drawn systematically, in proportion to weight times cosine, and looked at
// from the sun. Replicates with other scrambles measure the noise, and true suns among the hours
// the error of interpolation; replicates are added, and the table of suns refined, until both are
// small.
//
// Whatever transmits without holes (glass, fabric, crowns) dims paths and does not reflect them.
class Transport {
 public:
  // `rays`: of the scene, which must outlive this; RayFaces::both, or paths pass through faces that
  // are turned away. `reflectances`: one for each surface of the scene. Throws Error if one is not
  // 0 .. 1, if a diffuse and a specular one are more than 1 together, or if there are not as many.
  Transport(Scene const& scene, RayScene const& rays, std::vector<FaceReflectances> reflectances,
            std::optional<ReflectingGround> ground);

  // `seed`: receivers with different seeds have independent errors. Factors, deployments and the
  // receiver's own rule are those of `conditions`; conditions.receiver is replaced.
  Transported to(SurfaceId receiver, TransportRequest const& request,
                 RayConditions const& conditions = {}, std::uint32_t seed = 0) const;

  // Several receivers, in their order, each with a seed of its name: the same in any order.
  std::vector<Transported> to(std::span<SurfaceId const> receivers, TransportRequest const& request,
                              RayConditions const& conditions = {}) const;

 private:
  Scene const& scene_;
  RayScene const& rays_;
  std::vector<glm::dvec3> normals_;
  std::vector<FaceReflectances> reflectances_;
  std::optional<ReflectingGround> ground_;
  std::shared_ptr<Mirrors const> mirrors_;
};

}  // namespace gpu_shading
