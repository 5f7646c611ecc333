#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gpu_shading {

// The area that the sun lights through one combination of scheduled shades.
struct ScheduledPart {
  std::vector<std::pair<int, int>> powers;  // schedule and number of its shades, sorted by schedule
  double projected_area = 0.0;              // m2 at factors of 1, transmittances included
};

// The total with factors[schedule]: each part times the factors of its schedules, raised to the
// numbers of their shades. Throws Error if there are too few factors.
double through_schedules(std::span<ScheduledPart const> parts, std::span<double const> factors);

// The sunlit area of one receiver.
struct Sunlit {
  // Projected sunlit surface area (PSSA), m2 normal to the beam: the receiver's exact projected
  // area times the sunlit fraction of its own pixels, each weighted by the transmittance of the
  // unscheduled shades in front of it. 0 if the receiver faces away from the sun. The sunlit area
  // itself is this divided by the cosine of the angle of incidence. Areas lit through scheduled
  // shades are additional.
  double projected_area = 0.0;
  // One part for each combination of schedules.
  std::vector<ScheduledPart> scheduled;
  // The measured error that 99 % of sunlit fractions stay within: at least `rounding` where a view
  // was sampled, 0 where it was answered exactly, which is within `rounding`. Empty if a sampled
  // view's error was not measured. For an interior surface, of its share of what reaches the
  // window.
  static constexpr double rounding = 1e-7;
  std::optional<double> error = 0.0;

  // The total with factors[schedule]. Throws Error if there are too few factors.
  double at(std::span<double const> factors) const {
    return projected_area + through_schedules(scheduled, factors);
  }
};

}  // namespace gpu_shading
