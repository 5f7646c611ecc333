#include "model/site/weather_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;
using testing::Optional;
using testing::Pair;

class WeatherHeader : public testing::Test {
 protected:
  std::filesystem::path file(std::string const& text) const {
    auto path = folder_.path() / "w.epw";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  WeatherSite site(std::string const& text) const { return read_weather_site(file(text)); }
  auto saving(std::string const& text) const { return read_daylight_saving(file(text)); }

 private:
  TemporaryFolder folder_;
};

std::string const golden_line = "LOCATION,Golden,CO,USA,TMY3,724666,39.74,-105.18,-7.0,1829.0\n";

TEST_F(WeatherHeader, LocationIsTheFirstLine) {
  auto const found = site(golden_line + "DESIGN CONDITIONS,0\n");
  EXPECT_EQ(found.name, "Golden");
  EXPECT_EQ(found.latitude, 39.74);
  EXPECT_EQ(
      site("LOCATION,Denver  Golden   Nr,CO,USA,TMY3,724666,39.74,-105.18,-7.0,1829.0\n").name,
      "Denver Golden Nr");
  EXPECT_EQ(found.longitude, -105.18);
  EXPECT_EQ(found.time_zone, -7.0);
  EXPECT_EQ(found.elevation, 1829.0);
}

TEST_F(WeatherHeader, SaysWhatIsWrongWithTheLocation) {
  for (auto const* const text : {"", "LOCATION,Golden", "\nLOCATION,a,b,c,d,e,1,2,3,4\n"}) {
    EXPECT_THAT(refusal_of([&] { site(text); }),
                HasSubstr("w.epw: expected a weather file (EPW), with LOCATION"));
  }
  EXPECT_THAT(refusal_of([&] { site("LOCATION,a,b,c,d,e,nan,2,3,4\n"); }),
              HasSubstr("w.epw: LOCATION: latitude is \"nan\", expected a number from -90 to 90"));
  EXPECT_THAT(refusal_of([&] { site("LOCATION,a,b,c,d,e,1,181,3,4\n"); }),
              HasSubstr("longitude is \"181\", expected a number from -180 to 180"));
  EXPECT_THAT(refusal_of([&] { site("LOCATION,a,b,c,d,e,1,2,3,high\n"); }),
              HasSubstr("elevation is \"high\", expected a number from -10000 to 10000"));
}

TEST_F(WeatherHeader, DaylightSavingIsInAnyOfTheFirstEightLines) {
  std::string const line = "HOLIDAYS/DAYLIGHT SAVINGS,No,4/ 1,10/31,0\r\n";
  EXPECT_THAT(saving(golden_line + "\n\r\n" + line), Optional(Pair("4/ 1", "10/31")));
  EXPECT_THAT(saving(golden_line + std::string(6, '\n') + line), Optional(Pair("4/ 1", "10/31")));
  EXPECT_EQ(saving(golden_line + std::string(7, '\n') + line), std::nullopt);
  EXPECT_EQ(saving(golden_line + "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"), std::nullopt);
  EXPECT_EQ(saving(golden_line + "HOLIDAYS/DAYLIGHT SAVINGS\n"), std::nullopt);
}

TEST_F(WeatherHeader, SaysWhatIsNoDay) {
  EXPECT_THAT(refusal_of([&] { saving("HOLIDAYS/DAYLIGHT SAVINGS,No,4/1,31 April,0\n"); }),
              HasSubstr("w.epw: HOLIDAYS/DAYLIGHT SAVINGS: \"31 April\" is not a day"));
  EXPECT_THAT(refusal_of([&] { saving("HOLIDAYS/DAYLIGHT SAVINGS,No,4/1\n"); }),
              HasSubstr("\"\" is not a day"));
}

// A line that does not end must not fill the memory.
TEST_F(WeatherHeader, LinesHaveAnEnd) {
  std::string const most(std::size_t{1} << 20U, ' ');
  EXPECT_THAT(refusal_of([&] { site(golden_line + most); }),
              HasSubstr("w.epw: its first 8 lines are longer than 1 MiB"));
  // What comes after eight lines may be long.
  EXPECT_EQ(site(golden_line + std::string(7, '\n') + most).name, "Golden");
}

}  // namespace
}  // namespace gpu_shading::energyplus
