// What goes between EnergyPlus and the renderer where the library cannot be patched: outputs that
// are read, files that are written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <numbers>
#include <sstream>

#include "gpu_shading/error.h"
#include "platform/progress.h"
#include "routes/schedules/schedule_table.h"
#include "runs/drawing.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// As EnergyPlus writes it, but for most of the codes that mean nothing here.
std::string polyline(std::string const& comment, std::vector<std::string> const& coordinates) {
  std::string text = "999\n" + comment + "\n  0\nPOLYLINE\n  8\n1\n 10\n 0.0\n 20\n 0.0\n";
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    text += "  0\nVERTEX\n  8\n1\n 10\n" + coordinates[i] + "\n 20\n" + coordinates[i + 1] +
            "\n 30\n" + coordinates[i + 2] + "\n";
  }
  return text + "  0\nSEQEND\n  8\n1\n";
}

TEST(Drawing, NamesAndVertices) {
  std::vector<std::string> const triangle{"0.5", "1", "2", "      -3.25000", "4", "5",
                                          "6",   "7", "8"};
  std::istringstream dxf("  0\nSECTION\n999\nZone=1:WEST\n999\nZone=2:WEST:UPPER\n" +
                         polyline("Building Shading:A:B", triangle) +
                         polyline("Building Shading:Mir-A:B", triangle) +
                         polyline("WEST:WALL", triangle) +
                         polyline("WEST:UPPER:FINS Left", triangle) + "  0\nENDSEC\n  0\nEOF\n");
  auto const surfaces = read_drawing(dxf);
  ASSERT_EQ(surfaces.size(), 3U);
  EXPECT_EQ(surfaces[0].name, "A:B");
  EXPECT_EQ(surfaces[1].name, "WALL");
  EXPECT_EQ(surfaces[2].name, "FINS Left");
  EXPECT_THAT(surfaces[0].outline,
              ElementsAre(glm::dvec3(0.5, 1, 2), glm::dvec3(-3.25, 4, 5), glm::dvec3(6, 7, 8)));
}

TEST(Drawing, CutShort) {
  std::istringstream dxf("  0\nSECTION\n");
  EXPECT_THROW(read_drawing(dxf), Error);
}

// A wall facing south with a window 0.2 m behind it.
TEST(DrawnSurfaces, SetBackWindow) {
  ShadingInput input;
  input.zone_of["WALL"] = "ZONE";
  input.base_of["WINDOW"] = "WALL";
  std::vector<DrawnSurface> const drawing{
      {"WALL", {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}},
      {"WINDOW", {{1, 0.2, 1}, {3, 0.2, 1}, {3, 0.2, 2}, {1, 0.2, 2}}}};
  auto const surfaces = surfaces_of(drawing, input);
  ASSERT_EQ(surfaces.size(), 6U);
  EXPECT_DOUBLE_EQ(area(surfaces[0].polygon), 10.0);
  EXPECT_DOUBLE_EQ(surfaces[0].polygon.holes[0][0].y, 0.0);
  EXPECT_EQ(surfaces[2].name, "WINDOW reveal 1");
  double sides = 0.0;
  for (std::size_t i = 2; i < surfaces.size(); ++i) sides += area(surfaces[i].polygon);
  EXPECT_NEAR(sides, 0.2 * 6.0, 1e-12);
  EXPECT_TRUE(is_exterior("Window", input));
  input.not_exterior.insert("WALL");
  EXPECT_FALSE(is_exterior("Window", input));
}

std::string const dictionary =
    "Program Version,EnergyPlus\n"
    "2,8,Day of Simulation[],Month[],Day of Month[],DST Indicator[1=yes 0=no],Hour[],StartMinute[],"
    "EndMinute[],DayType\n"
    "7,1,Environment,Site Solar Azimuth Angle [deg] !TimeStep\n"
    "8,1,Environment,Site Solar Altitude Angle [deg] !TimeStep\n"
    "9,1,Leaves,Schedule Value [] !TimeStep\n"
    "End of Data Dictionary\n";

TEST(RunTimes, EveryTimestep) {
  std::istringstream eso(dictionary +
                         "1,YEAR,  39.74,-105.18,  -7.00,1829.00\n"
                         "2,1, 3, 1, 0,24,30.00,45.00,Sunday\n7,180\n8,45\n9,0.25\n"
                         "2,1, 2,29, 0, 1, 0.00,15.00,Sunday\n7,90\n8,-30\n9,0.5\n"
                         "End of Data\n");
  auto const run = read_run_times(eso);
  EXPECT_EQ(run.steps_per_hour, 4);
  EXPECT_THAT(run.schedules, ElementsAre("LEAVES"));
  ASSERT_EQ(run.times.size(), 2U);
  EXPECT_EQ(run.times[0].day, 29);
  EXPECT_EQ(run.times[1].timestep, 3);
  EXPECT_DOUBLE_EQ(run.times[1].sun.azimuth, std::numbers::pi);
  EXPECT_DOUBLE_EQ(run.times[1].sun.altitude, std::numbers::pi / 4);
  EXPECT_EQ(run.times[1].schedules[0], 0.25);
  EXPECT_EQ(row_of(run.times[0], 4), 59U * 96U);
  EXPECT_EQ(row_of(run.times[1], 4), 60U * 96U + 23U * 4U + 2U);
}

TEST(RunTimes, AScheduleThatIsMissingOrNotANumberIsAnError) {
  RunTimes run{1, {}, {"LEAVES", "TILT"}};
  run.times.push_back({1, 1, 12, 1, {}, {0.25, std::numeric_limits<double>::quiet_NaN()}});
  EXPECT_EQ(schedule_value(run, run.times[0], "LEAVES"), 0.25);
  EXPECT_THAT([&] { schedule_value(run, run.times[0], "OTHER"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("none called \"OTHER\"")));
  EXPECT_THAT([&] { schedule_value(run, run.times[0], "TILT"); },
              testing::ThrowsMessage<Error>(
                  "schedule \"TILT\" has the value nan; expected a finite number"));
}

TEST(RunTimes, FileThatIsCut) {
  std::istringstream cut(dictionary + "2,1, 3, 1, 0,12, 0.00,15.00,Sunday\n7,180\n8,45\n9,1\n");
  EXPECT_THROW(read_run_times(cut), Error);
}

TEST(RunTimes, YearOfTheFirstRunPeriod) {
  std::string const sizing = "Environment,DAY,SizingPeriod:DesignDay, 10/21,10/21,...\n";
  std::istringstream eio(sizing +
                         "Environment,YEAR,WeatherFileRunPeriod,01/01/2017,12/31/2017,Sunday\n"
                         "Environment,MORE,WeatherFileRunPeriod,01/01/2020,12/31/2020,Sunday\n");
  EXPECT_EQ(read_first_year(eio), 2017);
  for (std::string const date : {"", "01/01", "01/01/nan", "01/01/1e300", "01/01/-5"}) {
    std::istringstream without(
        fmt::format("{}Environment,YEAR,WeatherFileRunPeriod,{},\n", sizing, date));
    EXPECT_THROW(read_first_year(without), Error) << date;
  }
}

TEST(RunTimes, RunPeriodsThatDisagree) {
  auto const twice = [](std::string const& altitude) {
    return dictionary + "2,1, 3, 1, 0,12, 0.00,15.00,Sunday\n7,180\n8,45\n9,1\n" +
           "2,1, 3, 1, 0,12, 0.00,15.00,Monday\n7,180\n8," + altitude + "\n9,1\nEnd of Data\n";
  };
  std::istringstream same(twice("45.001"));
  EXPECT_EQ(read_run_times(same).times.size(), 1U);
  std::istringstream other(twice("45.2"));
  EXPECT_THROW(read_run_times(other), Error);
}

std::vector<std::string> lines_of(std::string const& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ScheduleTable, FileIsOfALeapYear) {
  ScheduleTable const table{{"WALL", "WINDOW"}, 1e-9, 2, {{3, 1, 12, 2, {}, {}}}, {{0.25F, 1.0F}}};
  std::ostringstream out;
  write_schedule_file(table, out);
  auto const lines = lines_of(out.str());
  ASSERT_EQ(lines.size(), 1U + 366U * 48U);
  EXPECT_EQ(lines[0], "WALL,WINDOW");
  EXPECT_EQ(lines[1 + 60 * 48 + 23], "0.25,1");
  EXPECT_EQ(lines[1 + 60 * 48 + 24], "1e-09,1e-09");
}

std::string shown(bool terminal, Progress::Clock::duration patience) {
  std::FILE* const file = std::tmpfile();
  {
    Progress progress("work", 40, file, terminal, patience);
    for (std::size_t done = 1; done <= 40; ++done) progress.at(done);
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

TEST(Progress, LinesOnAFileAndABarOnATerminal) {
  auto const lines = lines_of(shown(false, {}));
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_EQ(lines[0], "gpu_shading: work: 10 %");
  EXPECT_EQ(lines[9], "gpu_shading: work: 100 %");
  auto const bar = shown(true, {});
  EXPECT_THAT(bar,
              HasSubstr("\rgpu_shading: work [####################....................]  50 %"));
  EXPECT_EQ(lines_of(bar).size(), 1U);
  EXPECT_EQ(bar.back(), '\n');
  EXPECT_EQ(shown(false, std::chrono::hours(1)), "");
}

}  // namespace
}  // namespace gpu_shading::energyplus
