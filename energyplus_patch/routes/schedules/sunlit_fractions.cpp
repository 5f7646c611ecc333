#include "routes/schedules/sunlit_fractions.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <ostream>

namespace gpu_shading::energyplus {
namespace {

constexpr int hours_of_day = 24;

// Calls `row` for each timestep of a leap year with the table's fractions at that time, or nullptr.
template <typename Row>
void for_each_row(SunlitFractions const& table, Row const& row) {
  constexpr std::array<int, 12> days{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  std::size_t at = 0;
  for (int month = 1; month <= static_cast<int>(days.size()); ++month) {
    for (int day = 1; day <= days.at(static_cast<std::size_t>(month - 1)); ++day) {
      for (int hour = 1; hour <= hours_of_day; ++hour) {
        for (int step = 1; step <= table.steps_per_hour; ++step) {
          RunTime const time{month, day, hour, step, {}, {}};
          auto const number = row_of(time, table.steps_per_hour);
          bool const known =
              at < table.times.size() && row_of(table.times[at], table.steps_per_hour) == number;
          row(known ? &table.fractions[at] : nullptr);
          if (known) ++at;
        }
      }
    }
  }
}

}  // namespace

void write_schedule_file(SunlitFractions const& table, std::ostream& out) {
  for (std::size_t i = 0; i < table.surfaces.size(); ++i) {
    out << (i == 0 ? "" : ",") << table.surfaces[i];
  }
  out << '\n';
  std::string dark;
  for (std::size_t i = 0; i < table.surfaces.size(); ++i) dark += i == 0 ? "0" : ",0";
  for_each_row(table, [&](std::vector<float> const* fractions) {
    if (fractions == nullptr) {
      out << dark << '\n';
      return;
    }
    fmt::memory_buffer line;
    for (std::size_t i = 0; i < fractions->size(); ++i) {
      fmt::format_to(std::back_inserter(line), "{}{:.7g}", i == 0 ? "" : ",", (*fractions)[i]);
    }
    out.write(line.data(), static_cast<std::streamsize>(line.size())) << '\n';
  });
}

}  // namespace gpu_shading::energyplus
