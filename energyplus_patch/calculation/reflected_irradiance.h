#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "calculation/step_error.h"
#include "gpu_shading/transport.h"
#include "platform/messages.h"
#include "scene/perez_sky.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Irradiance that one receiver gets by way of diffuse reflections of any number, W/m2.
struct Reflected {
  double by_ground = 0.0;  // on paths on which the ground reflects
  double by_shades = 0.0;  // shades, neighbours and the building alone

  double sum() const { return by_ground + by_shades; }
};

// The reflected light of Model::reflected_light's receivers at the times of a run. The light of
// each state of the shades (positions, schedules) is traced when a run first meets it.
class ReflectedIrradiance {
 public:
  // The scene must be complete() and outlive this. `latitude`: radians. The .eio file gets what was
  // measured of each receiver when it is traced.
  ReflectedIrradiance(SceneAssembly const& scene, double latitude, Messages messages);

  // A time of a run.
  struct Time {
    Moment moment;  // at which schedules are read
    SkyWeather weather;
    double ground = 0.2;  // the ground's reflectance, 0 .. 1
  };

  // In the receivers' order. `corners`: the positions of moving shades to interpolate between.
  std::vector<Reflected> at(Time const& time, std::vector<WeightedPositions> const& corners);

  // That of a receiver; none: EnergyPlus has no such surface, and the light is EnergyPlus's own.
  std::optional<SurfaceId> surface(std::size_t receiver) const {
    return at_[receiver] ? std::optional(ids_[*at_[receiver]]) : std::nullopt;
  }

  // After the last question: how much was traced, and how accurately.
  void describe() const;

 private:
  // Positions, factors and deployments.
  struct State {
    std::vector<double> positions;
    std::vector<double> schedules;

    bool operator<(State const& other) const {
      return std::tie(positions, schedules) < std::tie(other.positions, other.schedules);
    }
  };
  struct WeightedState {
    State state;
    double weight;
  };

  std::vector<WeightedState> states(Moment moment,
                                    std::vector<WeightedPositions> const& corners) const;
  std::vector<Transported> const& traced(State const& state);
  std::vector<Transported> trace(State const& state) const;
  void list(std::vector<Transported> const& tables) const;

  SceneAssembly const& scene_;
  double latitude_;
  Messages messages_;
  double traced_ground_ = 0.0;                  // its reflectance on the paths; 0: none is traced
  std::vector<SurfaceId> ids_;                  // of the receivers that EnergyPlus has
  std::vector<std::optional<std::size_t>> at_;  // by receiver: its place in ids_
  std::map<State, std::vector<Transported>> known_;  // in the order of ids_
};

// Of an ordinary year: EnergyPlus's own light from the ground, which nothing dims, divided by all
// reflected light that is traced, with the shades as they are now; by surface of the scene, which
// is in `ids`. Within some 10 %.
std::vector<double> undimmed_to_traced(SceneAssembly const& scene, double latitude,
                                       std::vector<SurfaceId> const& ids);

// The reflectance of a receiver's own ground by which EnergyPlus's light from the ground comes to
// `irradiance` (W/m2), at least min_ground_reflectance. `open`: of level ground in the open, W/m2,
// above 0.
double ground_reflectance(double irradiance, double open, double ground_view);

}  // namespace gpu_shading::energyplus
