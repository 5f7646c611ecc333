#include <fmt/format.h>

#include <cmath>

#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

double Sunlit::at(std::span<double const> factors) const {
  double sum = projected_area;
  for (ScheduledPart const& part : scheduled) {
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
