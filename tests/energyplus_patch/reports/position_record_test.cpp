#include "reports/position_record.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace gpu_shading::energyplus {
namespace {

std::vector<MovingShade> louvres_and_awning() {
  MovingShade louvres;
  louvres.name = "Louvres, south";
  MovingShade awning;
  awning.name = "Awning";
  awning.motion = MovingShade::Motion::extend;
  return {louvres, awning};
}

RunDay day_in_june(int day, bool warm_up = false) {
  return {.kind = RunDay::Kind::run_period,
          .environment = 3,
          .month = 6,
          .day = day,
          .warm_up = warm_up};
}

PositionRecord record_of_three() {
  PositionRecord record;
  record.note(day_in_june(1, true), {1, 1}, {{5.0, "clear"}, {0.1, "scheduled"}});  // not written
  record.note({}, {1, 1}, {{5.0, "clear"}, {0.1, "scheduled"}});                    // nor sizing
  record.note(day_in_june(1), {1, 1}, {{10.0, "blocking"}, {0.5, "scheduled"}});
  record.note(day_in_june(1), {1, 2}, {{10.0, "held"}, {1.0, "scheduled"}});
  record.note(day_in_june(2), {1, 1}, {{80.0, "windy"}, {0.25, "scheduled"}});
  return record;
}

TEST(PositionRecord, KnowsTheEndsOfHours) {
  PositionRecord record;
  for (int timestep = 1; timestep <= 4; ++timestep) {
    auto day = day_in_june(1);
    day.steps_per_hour = 4;
    record.note(day, {9, timestep}, {{10.0 * timestep, "scheduled"}});
    day.kind = RunDay::Kind::design_day;
    record.note(day, {9, timestep}, {{1.0, "windy"}});
  }
  auto const hours = record.ends_of_hours(RunDay::Kind::run_period);
  ASSERT_EQ(hours.size(), 1U);
  EXPECT_EQ(hours.begin()->first, (std::array{6, 1, 9}));
  EXPECT_EQ(hours.begin()->second->front().position, 40.0);
}

TEST(PositionRecord, HasARowForEachTimestepAfterTheWarmUp) {
  auto const folder = std::filesystem::path(testing::TempDir()) / "position_record_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  {
    StagedFiles files(folder);
    record_of_three().write(files, louvres_and_awning());
    files.commit();
  }
  std::ifstream file(folder / positions_table);
  std::string const table{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(table,
            "environment,month,day,hour,timestep,\"Louvres, south position [deg]\","
            "\"Louvres, south state\",Awning position [share],Awning state\n"
            "3,6,1,1,1,10,blocking,0.5,scheduled\n"
            "3,6,1,1,2,10,held,1,scheduled\n"
            "3,6,2,1,1,80,windy,0.25,scheduled\n");
  std::filesystem::remove_all(folder);
}

TEST(PositionRecord, CountsMoves) {
  std::string remarks;
  Messages const messages{
      [](auto const&) {}, [&](std::string const& line) { remarks += line + '\n'; }, {}};
  record_of_three().describe(louvres_and_awning(), messages);
  EXPECT_EQ(remarks,
            "moving shade Louvres, south: 10 to 80 deg, moved at 1 of 3 timesteps\n"
            "moving shade Awning: 0.25 to 1 share, moved at 2 of 3 timesteps\n");
  remarks.clear();
  PositionRecord().describe(louvres_and_awning(), messages);
  EXPECT_EQ(remarks, "");
}

}  // namespace
}  // namespace gpu_shading::energyplus
