#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace gpu_shading::energyplus {

// The day of a year from the notations of EnergyPlus's objects and weather files: "4/30" (month
// first), "30 April", "Apr 30", "2nd Sunday in March", "Last Sunday in October". Throws Error.
std::chrono::year_month_day date_in(std::string_view text, std::chrono::year year);

// "Sunday" or its first three letters, in any case.
std::optional<std::chrono::weekday> weekday_of(std::string_view word);

}  // namespace gpu_shading::energyplus
