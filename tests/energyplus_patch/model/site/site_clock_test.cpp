#include "model/site/site_clock.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <glm/trigonometric.hpp>

#include "model/idf/model_file.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
namespace chrono = std::chrono;

std::string const golden = "Site:Location,Golden,39.74,-105.18,-7,1829;\n";

SiteClock clock_of(std::string const& idf) { return {read_idf(idf), std::nullopt}; }

ClockTime at(chrono::year_month_day date, chrono::minutes time) {
  return chrono::local_days(date) + time;
}

// The calendar's own, as published.
TEST(CalendarDate, AllForms) {
  EXPECT_EQ(date_in("4/30", 2017y), 2017y / 4 / 30);
  EXPECT_EQ(date_in(" 4/ 1", 2017y), 2017y / 4 / 1);
  EXPECT_EQ(date_in("30 April", 2017y), 2017y / 4 / 30);
  EXPECT_EQ(date_in("apr 30", 2017y), 2017y / 4 / 30);
  EXPECT_EQ(date_in("2nd Sunday in March", 2024y), 2024y / 3 / 10);
  EXPECT_EQ(date_in("2 Sunday in March", 2024y), 2024y / 3 / 10);
  EXPECT_EQ(date_in("1st Sunday in November", 2017y), 2017y / 11 / 5);
  EXPECT_EQ(date_in("Last Sunday in October", 2023y), 2023y / 10 / 29);
  EXPECT_EQ(date_in("2/29", 2024y), 2024y / 2 / 29);
}

TEST(CalendarDate, SaysWhatIsNone) {
  for (auto const* const text : {"2/29", "13/1", "31 April", "6th Sunday in May", "Sunday in May",
                                 "5th Sunday in February", "April", "", "4/30/2017"}) {
    EXPECT_THAT(refusal_of([&] { date_in(text, 2017y); }),
                HasSubstr(fmt::format("\"{}\" is not a day of 2017, expected", text)));
  }
}

TEST(SiteClock, DaylightSavingFromTheFirstToTheLastDay) {
  auto const clock = clock_of(
      golden + "RunPeriodControl:DaylightSavingTime,2nd Sunday in March,1st Sunday in November;");
  EXPECT_FALSE(clock.saves_daylight(at(2024y / 3 / 9, 12h)));
  EXPECT_TRUE(clock.saves_daylight(at(2024y / 3 / 10, 12h)));
  EXPECT_TRUE(clock.saves_daylight(at(2024y / 11 / 3, 12h)));
  EXPECT_FALSE(clock.saves_daylight(at(2024y / 11 / 4, 12h)));
  // 14:00 is 13:00 of standard time.
  EXPECT_EQ(clock.sun(at(2024y / 6 / 21, 14h)), clock_of(golden).sun(at(2024y / 6 / 21, 13h)));
}

TEST(SiteClock, SouthernDaylightSavingLastsOverTheNewYear) {
  auto const clock = clock_of(
      "Site:Location,Sydney,-33.87,151.21,10,6;\n"
      "RunPeriodControl:DaylightSavingTime,1st Sunday in October,1st Sunday in April;");
  EXPECT_TRUE(clock.saves_daylight(at(2023y / 12 / 21, 12h)));
  EXPECT_TRUE(clock.saves_daylight(at(2023y / 1 / 15, 12h)));
  EXPECT_FALSE(clock.saves_daylight(at(2023y / 6 / 21, 12h)));
}

TEST(SiteClock, TheWeatherFilesDaylightSavingUnlessTheRunPeriodSaysNo) {
  TemporaryFolder const folder;
  auto const weather = folder.path() / "w.epw";
  std::ofstream(weather) << "LOCATION,X\nHOLIDAYS/DAYLIGHT SAVINGS,No,4/ 1,10/31,0\n";
  auto const saves = [&](std::string const& period) {
    return SiteClock(read_idf(golden + period), weather).saves_daylight(at(2017y / 6 / 1, 12h));
  };
  EXPECT_TRUE(saves(""));
  EXPECT_TRUE(saves("RunPeriod,Year,1,1,,12,31,,,Yes,Yes;"));
  EXPECT_FALSE(saves("RunPeriod,Year,1,1,,12,31,,,Yes,No;"));
  EXPECT_FALSE(saves("RunPeriodControl:DaylightSavingTime,7/1,8/1;"));
  std::ofstream(weather) << "LOCATION,X\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n";
  EXPECT_FALSE(saves(""));
}

TEST(SiteClock, TheYearIsTheRunPeriods) {
  EXPECT_EQ(clock_of(golden).year(), 2017y);
  EXPECT_EQ(clock_of(golden + "RunPeriod,Year,1,1,2020,12,31;").year(), 2020y);
  EXPECT_EQ(clock_of(golden + "RunPeriod,Year,1,1,,12,31;").year(), 2017y);
  // 2015 began on a Thursday.
  EXPECT_EQ(clock_of(golden + "RunPeriod,Year,1,1,,12,31,,Thursday;").year(), 2015y);
}

// At equinoxes the sun rises in the east, whatever the latitude; at solstices noon is as high as
// latitude and obliquity say.
TEST(SiteClock, SunOfWellKnownDays) {
  auto const clock = clock_of("Site:Location,Meridian,40,0,0,0;");
  EXPECT_NEAR(glm::degrees(clock.sun(at(2017y / 6 / 21, 12h)).altitude), 90.0 - 40.0 + 23.44, 0.1);
  EXPECT_NEAR(glm::degrees(clock.sun(at(2017y / 12 / 21, 12h)).altitude), 90.0 - 40.0 - 23.44, 0.1);
  EXPECT_NEAR(glm::degrees(clock.sun(at(2017y / 3 / 20, 6h + 7min)).azimuth), 90.0, 0.5);
  EXPECT_LT(clock.sun(at(2017y / 6 / 21, 0h)).altitude, 0.0);
  // An hour east of the zone's meridian noon comes an hour before.
  auto const east = clock_of("Site:Location,East,40,15,0,0;");
  EXPECT_NEAR(east.sun(at(2017y / 6 / 21, 11h)).azimuth, clock.sun(at(2017y / 6 / 21, 12h)).azimuth,
              1e-12);
}

TEST(SiteClock, LocationsHaveNumbers) {
  EXPECT_NO_THROW(check_location(read_idf("")));
  EXPECT_NO_THROW(check_location(read_idf("Site:Location,Golden;")));
  EXPECT_NO_THROW(check_location(read_idf(golden)));
  EXPECT_THAT(refusal_of([] { check_location(read_idf("Site:Location,Golden,39.74,0,nan,0;")); }),
              HasSubstr("Site:Location Golden: Time Zone is \"nan\", expected a number from -12 to "
                        "14 hr"));
}

TEST(SiteClock, SaysWhatIsWrong) {
  EXPECT_THAT(refusal_of([] { clock_of(""); }), HasSubstr("Site:Location is missing"));
  EXPECT_THAT(
      refusal_of([] { clock_of("Site:Location,Golden,north;"); }),
      HasSubstr(
          "Site:Location Golden: Latitude is \"north\", expected a number from -90 to 90 deg"));
  EXPECT_THAT(
      refusal_of([] { clock_of(golden + "RunPeriodControl:DaylightSavingTime,spring,autumn;"); }),
      HasSubstr("RunPeriodControl:DaylightSavingTime: \"spring\" is not a day"));
  EXPECT_THAT(refusal_of([] { SiteClock(read_idf(golden), "/nowhere/w.epw"); }),
              HasSubstr("/nowhere/w.epw: no such file"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
