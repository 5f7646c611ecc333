#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Answers kept by direction and by the state of the screens' deployments: warm-up days, sizing
// periods and the sky's patches come back to the same ones. They hold whatever the transmittance
// schedules say, which are applied to them afterwards. Bounded: when full, everything is forgotten
// and collected anew.
class Answers {
 public:
  static constexpr std::size_t max_bytes = std::size_t{512} << 20U;

  struct Direction {
    SunDirection sun;
    std::uint32_t state = 0;            // DeploymentStates
    std::vector<float> projected_area;  // by surface; not a number where not asked yet
    // What passes scheduled shades, of the surfaces that have such in view.
    std::unordered_map<SurfaceId, std::vector<ScheduledPart>> scheduled;
    std::unordered_map<std::uint64_t, std::vector<Sunlit>> interior;  // by window and list

    // A known answer with the schedules' values.
    double area(SurfaceId surface, std::span<double const> factors) const;
  };

  explicit Answers(std::size_t surfaces = 0) : surfaces_(surfaces) {}

  // The entry of a direction and a state, made where there is none. Valid until the next call.
  Direction& at(SunDirection sun, std::uint32_t state);

  static bool known(float answer) { return answer == answer; }

  template <typename Visit>
  void for_each(Visit const& visit) const {
    for (auto const& [key, direction] : directions_) visit(direction);
  }

 private:
  struct Key {
    SunDirection sun;
    std::uint32_t state;

    bool operator==(Key const&) const = default;
  };
  struct Hash {
    std::size_t operator()(Key const& key) const {
      std::hash<double> const hash;
      constexpr std::size_t odd = 0x9e3779b97f4a7c15;
      return (hash(key.sun.azimuth) * odd ^ hash(key.sun.altitude)) * odd ^ key.state;
    }
  };

  std::size_t surfaces_;
  std::unordered_map<Key, Direction, Hash> directions_;
};

}  // namespace gpu_shading::energyplus
