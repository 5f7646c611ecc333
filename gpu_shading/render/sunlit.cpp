#include "gpu_shading/sunlit.h"

#include <fmt/format.h>

#include <cmath>

#include "gpu_shading/error.h"

namespace gpu_shading {

double through_schedules(std::span<ScheduledPart const> parts, std::span<double const> factors) {
  double sum = 0.0;
  for (ScheduledPart const& part : parts) {
    double area = part.projected_area;
    for (auto const& [schedule, power] : part.powers) {
      if (static_cast<std::size_t>(schedule) >= factors.size()) {
        throw Error(fmt::format("a factor for schedule {} is missing: {} were given", schedule,
                                factors.size()));
      }
      area *= std::pow(factors[static_cast<std::size_t>(schedule)], power);
    }
    sum += area;
  }
  return sum;
}

}  // namespace gpu_shading
