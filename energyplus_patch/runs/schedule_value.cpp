#include "runs/schedule_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

double checked_value(std::string_view schedule, double value) {
  if (std::isfinite(value)) return value;
  throw Error(fmt::format("schedule {} has the value {}; expected a finite number",
                          in_quotes(schedule), value));
}

double checked_share(std::string_view schedule, double value) {
  return std::clamp(checked_value(schedule, value), 0.0, 1.0);
}

}  // namespace gpu_shading::energyplus
