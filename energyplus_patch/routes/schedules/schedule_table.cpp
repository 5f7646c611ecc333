#include "routes/schedules/schedule_table.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <ostream>

namespace gpu_shading::energyplus {
namespace {

constexpr int hours_of_day = 24;

// Calls `row` for each timestep of a leap year with the table's values at that time, or nullptr.
template <typename Row>
void for_each_row(ScheduleTable const& table, Row const& row) {
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
          row(known ? &table.values[at] : nullptr);
          if (known) ++at;
        }
      }
    }
  }
}

template <typename Values>
std::string line_of(Values const& values) {
  fmt::memory_buffer line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::format_to(std::back_inserter(line), "{}{:.7g}", i == 0 ? "" : ",", values[i]);
  }
  line.push_back('\n');
  return fmt::to_string(line);
}

}  // namespace

void write_schedule_file(ScheduleTable const& table, std::ostream& out) {
  out << fmt::format("{}\n", fmt::join(table.columns, ","));
  auto const otherwise = line_of(std::vector<double>(table.columns.size(), table.otherwise));
  for_each_row(table, [&](std::vector<float> const* values) {
    out << (values == nullptr ? otherwise : line_of(*values));
  });
}

NewObject file_schedule(ScheduleTable const& table, std::size_t column, std::string const& name,
                        std::string const& limits, std::string const& file) {
  constexpr int minutes_of_hour = 60;
  constexpr int hours_of_leap_year = 8784;
  return {"Schedule:File",
          {{"name", name},
           {"schedule_type_limits_name", limits},
           {"file_name", file},
           {"column_number", column + 1},
           {"rows_to_skip_at_top", 1},
           {"number_of_hours_of_data", hours_of_leap_year},
           {"column_separator", "Comma"},
           {"interpolate_to_timestep", "No"},
           {"minutes_per_item", minutes_of_hour / table.steps_per_hour},
           {"adjust_schedule_for_daylight_savings", "No"}}};
}

}  // namespace gpu_shading::energyplus
