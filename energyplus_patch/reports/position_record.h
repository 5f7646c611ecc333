#pragma once

#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "model/input/moving_shades.h"
#include "platform/messages.h"
#include "platform/staged_files.h"
#include "reports/run_record.h"

namespace gpu_shading::energyplus {

inline constexpr char const* positions_table = "positions.csv";

// Where moving shades stood at the timesteps of a run, without warm-up.
class PositionRecord {
 public:
  struct Entry {
    double position = 0.0;
    std::string_view state;  // in static storage
  };

  // By shade.
  void note(RunDay const& day, Moment moment, std::vector<Entry> entries);

  // What was noted at the end of each hour, by month, day and hour: of run periods or design days,
  // the last one if it was simulated more than once.
  using Hours = std::map<std::array<int, 3>, std::vector<Entry> const*>;
  Hours ends_of_hours(RunDay::Kind kind) const;

  // positions.csv: environment number, month, day, hour, timestep, and the position and state of
  // each shade.
  void write(StagedFiles& files, std::vector<MovingShade> const& shades) const;
  // The range of positions and the number of moves of each shade. EnergyPlus has closed its .eio
  // file at the end of a run.
  void describe(std::vector<MovingShade> const& shades, Messages const& messages) const;

 private:
  struct Row {
    RunDay day;
    Moment moment;
    std::vector<Entry> entries;
  };
  std::vector<Row> rows_;
};

}  // namespace gpu_shading::energyplus
