#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <vector>

#include "calculation/session.h"
#include "routes/patched/memory/solar_reflections.h"
#include "routes/patched/memory/surface_luminance.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// EnergyPlus's functions of reflections in daylighting.
struct DaylightFunctions {
  PointerTo<symbol::closest_obstruction> closest = nullptr;
  PointerTo<symbol::sun_luminance> sun_luminance = nullptr;
  PointerTo<symbol::sky_on_ground> sky_on_ground = nullptr;
  PointerTo<symbol::inter_reflected> inter_reflected = nullptr;
  PointerTo<symbol::window_element> element = nullptr;
};

// Reflections in the daylighting of one run, with what EnergyPlus does not know. EnergyPlus asks
// for the nearest surface that a ray meets, then for its luminance by the sun, and takes its
// luminance by the sky from its own memory. Where hidden casters stand before that surface, a
// placeholder is named instead, with the luminance of all that is seen.
//
// EnergyPlus itself decides whether the sun reaches the ground, by its own surfaces: where hidden
// casters dim it, the illuminance by the sun that EnergyPlus multiplies is lowered for that ray.
// What its own surfaces reflect as mirrors is dimmed after EnergyPlus has added it.
class DaylightReflections {
 public:
  // Session and SolarReflections must outlive this, and the session have hidden casters.
  DaylightReflections(SolarReflections& solar, Session& session, DaylightFunctions const& original,
                      DaylightClasses const& classes)
      : solar_(solar), session_(session), original_(original), classes_(classes) {}

  // EnergyPlus computes daylighting for another period.
  void begin_period();
  void end_period();

  // EnergyPlus has computed an hour's illuminance on the horizontal.
  void add_horizontal(Illuminance& at);

  // EnergyPlus's functions. They throw Unexpected if its memory is not as expected.
  void closest(State& state, Vector const& from, Vector const& ray, int& surface, Vector& hit);
  double sun_luminance(State& state, int hour, Vector const& ray, int surface, Vector const& hit);
  double sky_on_ground(State& state, Vector const& point, int altitudes, int azimuths);
  void inter_reflected(State& state, int sun_position, int hour, int enclosure, int window);

  // EnergyPlus asks what obstructs a ray from a window or a reference point.
  void begin_ray(Vector const& direction);
  // EnergyPlus divides its sums by the illuminance on the horizontal.
  void begin_factors();
  // EnergyPlus asks what is between a reference point and a window. Returns whether nothing passes
  // of the sun's image in a mirror; nothing if that is not the ray's direction.
  std::optional<bool> stops_image(int window, Vector const& from, Vector const& to);

 private:
  // What EnergyPlus's ray meets of its own surfaces, behind hidden casters.
  struct Seen {
    Ray ray;
    int surface = 0;
    Vector hit{};
  };
  struct Image {
    glm::dvec3 direction;  // to it
    int hour;
    SurfaceId mirror;
  };
  // An hour at which hidden casters keep light of the sun from a point of the ground.
  struct Dimmed {
    int hour;
    double share;  // that is left
    double sun;    // EnergyPlus's illuminance
  };
  // The sun's disk in EnergyPlus's sums, before it adds that of an image.
  struct Added {
    int hour;
    double passed;
    Covers direct;
    Covers window;
  };
  static constexpr std::size_t hours = 24;

  HiddenLuminance& hidden() const { return *session_.luminance(); }
  Illuminance* horizontal(int hour) const;
  SurfaceLuminance::Ray ray_now(State& state, int hour, Vector const& ray) const;
  void dim_sun(glm::dvec3 const& ground);
  void dim_sun(int hour, double share);
  void undim_sun();
  std::vector<Image> const& images(int window);
  void settle();

  SolarReflections& solar_;
  Session& session_;
  DaylightFunctions original_;
  DaylightClasses classes_;
  std::optional<SurfaceLuminance::Measured> measured_;
  std::optional<SurfaceLuminance> surfaces_;
  std::optional<Seen> seen_;
  int window_ = 0;
  int inter_reflected_hour_ = 0;  // 0: it is not computed
  // Where the first hour's illuminance may be.
  std::vector<Illuminance*> first_hour_;
  std::vector<Dimmed> dimmed_;
  std::map<int, std::vector<Image>> images_;  // by window
  std::optional<Added> added_;
};

}  // namespace gpu_shading::energyplus
