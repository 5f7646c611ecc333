#include "gpu_shading/sun_position.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/degree.h"
#include "support/noaa_sun.h"

namespace gpu_shading {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::sys_seconds;

using std::numbers::pi;

sys_seconds at(int year, unsigned month, unsigned day, seconds time = seconds(0)) {
  return sys_days{std::chrono::year{year} / std::chrono::month{month} / std::chrono::day{day}} +
         time;
}

TEST(SunPosition, MeeusExamples25aAnd28b) {
  // 1992 October 13, 0 h.
  auto const sun = sun_at(at(1992, 10, 13));
  EXPECT_NEAR(sun.declination / degree, -7.78507, 0.002);
  EXPECT_NEAR(sun.equation_of_time, 13.0 + 42.6 / 60.0, 0.02);
}

TEST(SunPosition, ExampleOfReda2008) {
  // Reda & Andreas, Solar Position Algorithm (NREL/TP-560-34302), table A5.1: 2003 October 17,
  // 12:30:30 at UTC-7, 39.742476 N, 105.1786 W. Without refraction; it has parallax, 0.002 degrees.
  auto const time = at(2003, 10, 17, hours(19) + minutes(30) + seconds(30));
  auto const sun = sun_position(time, 39.742476 * degree, -105.1786 * degree);
  EXPECT_NEAR(sun.azimuth / degree, 194.34024, 0.01);
  EXPECT_NEAR(sun.altitude / degree, 39.872046, 0.01);
  auto const of_time = sun_at(time);
  EXPECT_NEAR(of_time.declination / degree, -9.31434, 0.005);
  EXPECT_NEAR(of_time.equation_of_time, 14.641503, 0.01);
}

TEST(SunPosition, EquinoxesAndSolsticesOfLeapAndOtherYears) {
  // US Naval Observatory, Earth's seasons, universal time.
  EXPECT_NEAR(sun_at(at(2020, 3, 20, hours(3) + minutes(50))).declination / degree, 0.0, 0.005);
  EXPECT_NEAR(sun_at(at(2021, 3, 20, hours(9) + minutes(37))).declination / degree, 0.0, 0.005);
  EXPECT_NEAR(sun_at(at(2023, 9, 23, hours(6) + minutes(50))).declination / degree, 0.0, 0.005);
  EXPECT_NEAR(sun_at(at(2024, 9, 22, hours(12) + minutes(44))).declination / degree, 0.0, 0.005);
  EXPECT_NEAR(sun_at(at(2024, 6, 20, hours(20) + minutes(51))).declination / degree, 23.437, 0.005);
  EXPECT_NEAR(sun_at(at(2024, 12, 21, hours(9) + minutes(20))).declination / degree, -23.437,
              0.005);
}

TEST(SunPosition, DaylightSavingIsTheClocksAlone) {
  // Noon in Denver (105 W, on its zone's meridian): 12:00 MST is 13:00 MDT is 19:00 universal.
  auto const time = at(2023, 7, 1, hours(13)) + hours(6);
  auto const sun = sun_position(time, 40.0 * degree, -105.0 * degree);
  double const late = sun_at(time).equation_of_time / 4.0;  // degrees
  EXPECT_NEAR(to_hour_direction(sun, 40.0 * degree).hour_angle / degree, late, 1e-6);
  EXPECT_LT(late, -0.9);
}

TEST(SunPosition, ThereAndBack) {
  for (double const latitude : {-90.0, -35.0, 0.0, 42.0, 66.5, 90.0}) {
    for (int declination = -23; declination <= 23; declination += 2) {
      for (int hour_angle = -179; hour_angle < 180; hour_angle += 14) {
        auto const direction = to_direction(
            HourDirection{declination * degree, hour_angle * degree}, latitude * degree);
        auto const back = to_hour_direction(direction, latitude * degree);
        EXPECT_NEAR(back.declination, declination * degree, 1e-12);
        EXPECT_NEAR(back.hour_angle, hour_angle * degree, 1e-12);
      }
    }
  }
}

TEST(SunPosition, NoonIsSouthInTheNorthAndNorthInTheSouth) {
  auto const north = to_direction(HourDirection{10 * degree, 0.0}, 42 * degree);
  EXPECT_NEAR(north.azimuth, pi, 1e-12);
  EXPECT_NEAR(north.altitude, 58 * degree, 1e-12);
  auto const south = to_direction(HourDirection{10 * degree, 0.0}, -35 * degree);
  EXPECT_NEAR(std::remainder(south.azimuth, 2 * pi), 0.0, 1e-12);
  EXPECT_NEAR(south.altitude, 45 * degree, 1e-12);
  // Afternoon is in the west in both.
  for (double const latitude : {42.0, -35.0}) {
    auto const sun = to_direction(HourDirection{0.0, 45 * degree}, latitude * degree);
    EXPECT_GT(sun.azimuth, pi);
  }
}

TEST(SunPosition, SunsetOnTheHorizonAndPolarDayAndNight) {
  for (double const latitude : {-66.0, -35.0, 0.0, 42.0, 66.0}) {
    for (double const declination : {-23.0, 0.0, 23.0}) {
      double const sunset = sunset_hour_angle(declination * degree, latitude * degree);
      auto const sun = to_direction(HourDirection{declination * degree, sunset}, latitude * degree);
      EXPECT_NEAR(sun.altitude, 0.0, 1e-9);
    }
  }
  EXPECT_EQ(sunset_hour_angle(23 * degree, 80 * degree), pi);
  EXPECT_EQ(sunset_hour_angle(-23 * degree, 80 * degree), 0.0);
  EXPECT_EQ(sunset_hour_angle(23 * degree, -90 * degree), 0.0);
  EXPECT_EQ(sunset_hour_angle(-1 * degree, -90 * degree), pi);
  EXPECT_NEAR(sunset_hour_angle(20 * degree, 0.0), pi / 2, 1e-12);
}

TEST(SunPosition, SunOfDayKeepsToTheSun) {
  double declination = 0.0;
  double equation = 0.0;
  for (int year = 2017; year <= 2024; ++year) {
    auto const first = at(year, 1, 1, hours(12));
    for (int day = 1; day <= 365; ++day) {
      auto const mean = sun_of_day(day);
      auto const sun = sun_at(first + hours(24) * (day - 1));
      declination = std::max(declination, std::abs(mean.declination - sun.declination));
      equation = std::max(equation, std::abs(mean.equation_of_time - sun.equation_of_time));
    }
  }
  RecordProperty("degrees", std::to_string(declination / degree));
  RecordProperty("minutes", std::to_string(equation));
  EXPECT_LT(declination, 0.5 * degree);
  EXPECT_LT(equation, 0.7);
}

}  // namespace
}  // namespace gpu_shading
