#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/rays.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"
#include "platform/messages.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// What a calculation needs of the simulation.
struct Simulation {
  Messages messages;
  Schedules schedules = {};
  // Latitude of the site, radians; only called if sun positions are sampled, or reflected
  // light is traced.
  std::function<double()> latitude = {};
  // Adds an output variable of EnergyPlus's for an object, in "deg", "m", "W/m2" or "" (no unit).
  // `value` is read at the end of each timestep. None: they cannot be added.
  std::function<void(std::string const& name, std::string_view unit, std::string const& object,
                     double& value)>
      add_output = {};
  bool takes_sky_multipliers = false;  // of Session::sky_multipliers()
};

// The shading calculation of one EnergyPlus run: first its surfaces, which are numbered from 0 in
// the order of adding, then start(), then times, suns and areas, in m2 normal to the beam.
// Functions throw gpu_shading::Error.
class ShadingCalculation {
 public:
  ShadingCalculation() = default;
  virtual ~ShadingCalculation() = default;
  ShadingCalculation(ShadingCalculation const&) = delete;
  ShadingCalculation& operator=(ShadingCalculation const&) = delete;
  ShadingCalculation(ShadingCalculation&&) = delete;
  ShadingCalculation& operator=(ShadingCalculation&&) = delete;

  virtual SurfaceId add(Surface surface) = 0;
  virtual std::size_t size() const = 0;

  // Whether the copies of shading surfaces that face the other way are of use, because their sunlit
  // fraction is shown or they reflect light; and adds the copy of one.
  virtual bool wants_mirrored() const = 0;
  virtual SurfaceId add_mirrored(SurfaceId original) = 0;

  virtual void start(Simulation simulation) = 0;

  // Sets the time at which schedules are evaluated from now on.
  virtual void set_time(Moment moment) = 0;
  virtual void set_sun(SunDirection sun) = 0;

  // The first question for a direction renders all receivers that were asked about before.
  virtual double projected_sunlit_area(SurfaceId receiver) = 0;
  virtual std::vector<double> projected_sunlit_areas(std::span<SurfaceId const> receivers) = 0;

  // The areas that the sun lights of interior surfaces through a window, in order. EnergyPlus keeps
  // those above 0 as the beam's of the timestep, even where it asks for a patch of the sky after
  // the sun (DetailedSkyDiffuseModeling with schedules): from there, they are 0.
  virtual std::vector<double> interior_areas(SurfaceId window,
                                             std::vector<SurfaceId> const& interiors) = 0;

  // Transmittance, 0 .. 1, of surfaces hidden from EnergyPlus for a ray of its daylighting, at an
  // hour of the day, 1 .. 24.
  virtual double daylight_transmittance(Ray const& ray, int hour) = 0;
  // EnergyPlus computes daylighting for another period.
  virtual void begin_daylighting() = 0;

  // GL_VENDOR of the device; "" for the CPU.
  virtual std::string vendor() = 0;

  // An answer could not be given, so the run ends, and its report would be of a part of it.
  virtual void fail() = 0;

  // Called at the end of the run: reports what was rendered.
  virtual void finish() = 0;
};

// From x, y, z of every vertex, one vertex after another, as EnergyPlus hands them over.
inline Ring to_ring(std::vector<float> const& xyz) {
  Ring ring;
  ring.reserve(xyz.size() / 3);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    ring.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return ring;
}

// EnergyPlus's WindowComplexManager has room for this many lit back surfaces per window.
inline constexpr std::size_t max_back_surfaces = 20;

// Keeps the max_back_surfaces largest areas and sets the others to 0; EnergyPlus adds the beam that
// no surface takes to the diffuse radiation.
inline void keep_largest(std::vector<double>& areas) {
  if (areas.size() <= max_back_surfaces) return;
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  for (std::size_t i = max_back_surfaces; i < order.size(); ++i) areas[order[i]] = 0.0;
}

}  // namespace gpu_shading::energyplus
