#pragma once

#include <map>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Light that reaches EnergyPlus's surfaces by way of ground, shades, neighbours and the building
// itself: what this module adds to EnergyPlus's input so that it may set it, and what reflects.
//
// EnergyPlus takes light from the ground as (beam x sin(altitude) + diffuse) x reflectance x view
// factor, with nothing between (Engineering Reference, "Ground Reflectances"). A
// SurfaceProperty:GroundSurfaces gives a surface a ground of its own, whose reflectance is a
// schedule: set to what all reflected light divided by the rest comes to, it passes any irradiance.
struct ReflectedLight {
  struct Receiver {
    std::string surface;   // EnergyPlus's name: an exterior surface, or its window or door
    std::string schedule;  // of its ground's reflectance
    // By which EnergyPlus multiplies light from the ground: (1 - cos(tilt)) / 2, or 1 for a surface
    // that faces up.
    double ground_view = 0.5;
  };

  std::vector<Receiver> receivers;  // empty: EnergyPlus's own terms
  bool undimmed = false;            // these are asked for, although objects of ours shade
  std::string schedule_limits;      // the ScheduleTypeLimits of their schedules
  // Diffuse solar reflectances, 0 .. 1, of the outsides of walls, roofs, floors and opaque doors,
  // by EnergyPlus's names; windows are missing.
  std::map<std::string, double> reflectances;
  // Solar reflectances of glass, a mirror, at normal incidence, 0 .. 1: of windows and glass doors,
  // and of the glazed part of shading surfaces.
  std::map<std::string, double> mirrors;
};

// EnergyPlus takes the reflectance 0 of a surface's own ground as Site:GroundReflectance.
inline constexpr double min_ground_reflectance = 1e-9;

}  // namespace gpu_shading::energyplus
