#include "reports/position_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "platform/text.h"

namespace gpu_shading::energyplus {

void PositionRecord::note(RunDay const& day, Moment moment, std::vector<Entry> entries) {
  // A year of four timesteps an hour has 35,040.
  constexpr std::size_t max_rows = 2'000'000;
  if (day.warm_up || day.kind == RunDay::Kind::other || rows_.size() >= max_rows) return;
  rows_.push_back({day, moment, std::move(entries)});
}

PositionRecord::Hours PositionRecord::ends_of_hours(RunDay::Kind kind) const {
  Hours hours;
  for (auto const& [day, moment, entries] : rows_) {
    if (day.kind != kind || moment.timestep != day.steps_per_hour) continue;
    hours[{day.month, day.day, moment.hour}] = &entries;
  }
  return hours;
}

void PositionRecord::write(StagedFiles& files, std::vector<MovingShade> const& shades) const {
  files.write(positions_table, [&](std::ostream& csv) {
    csv << "environment,month,day,hour,timestep";
    for (auto const& shade : shades) {
      csv << ',' << csv_field(fmt::format("{} position [{}]", shade.name, shade.unit())) << ','
          << csv_field(shade.name + " state");
    }
    csv << '\n';
    for (auto const& row : rows_) {
      csv << fmt::format("{},{},{},{},{}", row.day.environment, row.day.month, row.day.day,
                         row.moment.hour, row.moment.timestep);
      for (auto const& [position, state] : row.entries) {
        csv << fmt::format(",{:.9g},{}", position, state);
      }
      csv << '\n';
    }
  });
}

void PositionRecord::describe(std::vector<MovingShade> const& shades,
                              Messages const& messages) const {
  if (rows_.empty()) return;
  for (std::size_t i = 0; i < shades.size(); ++i) {
    double low = rows_.front().entries[i].position;
    double high = low;
    double before = low;
    std::size_t moves = 0;
    for (auto const& row : rows_) {
      double const position = row.entries[i].position;
      low = std::min(low, position);
      high = std::max(high, position);
      if (position != before) ++moves;
      before = position;
    }
    messages.remark(fmt::format("moving shade {}: {:.6g} to {:.6g} {}, moved at {} of {} timesteps",
                                shades[i].name, low, high, shades[i].unit(), moves, rows_.size()));
  }
}

}  // namespace gpu_shading::energyplus
