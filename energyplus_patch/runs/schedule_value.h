#pragma once

#include <string_view>

namespace gpu_shading::energyplus {

// The value of a schedule, unchanged. Throws Error, naming the schedule (not the field that names
// it), if the value is not a finite number: an EMS or another program can set any.
double checked_value(std::string_view schedule, double value);

// The same, limited to 0 .. 1.
double checked_share(std::string_view schedule, double value);

}  // namespace gpu_shading::energyplus
