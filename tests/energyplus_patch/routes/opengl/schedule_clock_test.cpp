#include "routes/opengl/schedule_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <sstream>

#include "gpu_shading/sun_direction.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string const dictionary =
    "Program Version,EnergyPlus\n"
    "2,8,Day of Simulation[],Month[],Day of Month[],DST Indicator[1=yes 0=no],Hour[],StartMinute[],"
    "EndMinute[],DayType\n"
    "9,1,Leaves,Schedule Value [] !TimeStep\n"
    "End of Data Dictionary\n";

ScheduleDays read(std::string const& text) {
  std::istringstream eso(dictionary + text);
  return read_schedule_days(eso);
}

TEST(ScheduleDays, ValuesByDayAndTimestep) {
  auto const read_days = read(
      "1,DESIGN DAY,  39.74,-105.18,  -7.00,1829.00\n"
      "2,1,10,21, 0,12,30.00,45.00,SummerDesignDay\n9,0.25\n"
      "1,YEAR,  40.00,-105.00,  -7.00,1829.00\n"
      "2,1,10,21, 0, 1, 0.00,15.00,Saturday\n9,0.5\n"
      "2,1,10,21, 0,24,45.00,60.00,Saturday\n9,0.75\n"
      "2,2,10,22, 0, 1, 0.00,15.00,Sunday\n9,1\n"
      "End of Data\n");
  EXPECT_EQ(read_days.steps_per_hour, 4);
  EXPECT_THAT(read_days.schedules, ElementsAre("LEAVES"));
  ASSERT_EQ(read_days.days.size(), 3U);
  EXPECT_EQ(read_days.days[0].type, "SummerDesignDay");
  EXPECT_EQ(read_days.days[0].longitude, -105.18);
  EXPECT_EQ(read_days.days[0].values[11 * 4 + 2], 0.25);
  EXPECT_EQ(read_days.days[0].days_left, 1);
  EXPECT_EQ(read_days.days[1].days_left, 2);
  EXPECT_EQ(read_days.days[1].values.front(), 0.5);
  EXPECT_EQ(read_days.days[1].values.back(), 0.75);
  EXPECT_EQ(read_days.days[2].latitude, 40.0);
}

TEST(ScheduleDays, RefusesWhatIsNone) {
  std::string const step = "2,1,10,21, 0,12,30.00,45.00,Monday\n9,0.25\n";
  EXPECT_THAT(refusal_of([&] { read(step); }), HasSubstr("ends before its End of Data"));
  for (std::string const bad :
       {"2,1,13,21, 0,12,30.00,45.00,Monday\n", "2,1,1,1,0,25,0,15,Monday\n",
        "2,1,1,1,0,1,15,15,Monday\n", "2,1,1,x,0,1,0,15,Monday\n",
        "2,1,1,1,0,1,0,15,Monday\n2,1,1,1,0,2,0,5,Monday\n"}) {
    EXPECT_THROW(read(step + bad + "End of Data\n"), Error) << bad;
  }
}

// A clock in Greenwich, where the sun is in the south at 12:00 less the equation of time.
ScheduleClock clock_on(int month, int day, int day_of_year, int steps) {
  ScheduleDays days{steps, {"LEAVES"}, {{month, day, "Monday", 1, 51.48, 0.0, 0.0, {}}}};
  auto& values = days.days[0].values;
  for (int i = 0; i < 24 * steps; ++i) values.push_back(i / (24.0 * steps));
  return {std::move(days), 20, [=] { return HostedDay{month, day, day_of_year, "Monday"}; }};
}

Moment at_noon(ScheduleClock const& clock) {
  return clock.moment_of(to_vector({glm::radians(180.0), glm::radians(20.0)})).value();
}

// The almanac's equation of time: 16.4 minutes on 3 November, -14.2 on 11 February.
TEST(ScheduleClock, ReadsTheTimeFromTheSun) {
  EXPECT_EQ(at_noon(clock_on(11, 3, 307, 4)), (Moment{12, 3}));    // ends at 11:45
  EXPECT_EQ(at_noon(clock_on(11, 3, 307, 60)), (Moment{12, 44}));  // 11:43.6
  EXPECT_EQ(at_noon(clock_on(2, 11, 42, 4)), (Moment{13, 1}));     // 12:15
  EXPECT_EQ(at_noon(clock_on(2, 11, 42, 1)), (Moment{13, 1}));     // the middle of that hour
  auto const clock = clock_on(2, 11, 42, 4);
  auto const west = clock.moment_of(to_vector({glm::radians(270.0), 1e-4}));
  EXPECT_EQ(west, (Moment{19, 1}));  // at 6 p.m. of the sun's time
}

TEST(ScheduleClock, ValuesOfTheDay) {
  auto const clock = clock_on(2, 11, 42, 4);
  EXPECT_EQ(clock.range("LEAVES"), std::pair(0.0, 95.0 / 96.0));
  EXPECT_EQ(clock.value("LEAVES", {13, 1}), 48.0 / 96.0);
  EXPECT_EQ(clock.value("LEAVES", {}), 0.0);
  EXPECT_THAT(refusal_of([&] {
                clock.value("ROOTS", {13, 1});
              }),
              HasSubstr("no schedule \"ROOTS\""));
}

}  // namespace
}  // namespace gpu_shading::energyplus
