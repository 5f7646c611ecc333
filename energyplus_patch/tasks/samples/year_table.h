#pragma once

#include <istream>
#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// In a folder of samples.
constexpr char const* year_file = "year.csv";

// A full hour of standard time on the 21st of a month.
struct SampledHour {
  int month = 0;  // 1 .. 12
  int hour = 0;   // 0 .. 23
  SunDirection sun;
  std::vector<double> fractions;  // by receiver, 0 .. 1
};

struct SampledHours {
  std::vector<std::string> receivers;  // as csv_field() writes their names
  std::vector<SampledHour> hours;
};

// The rows of write_year() that a shading mask shows. Throws Error.
SampledHours read_hours_of_21st(std::istream& csv);

}  // namespace gpu_shading::energyplus
