#include "answers/predicted_directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "gpu_shading/sun_position.h"
#include "scene/sky_grid.h"
#include "support/degree.h"

namespace gpu_shading::energyplus {
namespace {

// As EnergyPlus hands it over.
SunDirection in_single_precision(SunDirection sun) {
  return {static_cast<float>(sun.azimuth), static_cast<float>(sun.altitude)};
}

double apart(SunDirection a, SunDirection b) { return glm::distance(to_vector(a), to_vector(b)); }

// A day's directions with the sun up, by EnergyPlus's formula for a day of the year.
std::vector<SunDirection> day(int of_year, double latitude, int steps_an_hour,
                              double hour_at_noon = 12.2) {
  auto const sun = sun_of_day(of_year);
  std::vector<SunDirection> directions;
  for (int step = 1; step <= 24 * steps_an_hour; ++step) {
    double const hour = static_cast<double>(step) / steps_an_hour - hour_at_noon;
    double const angle = 15.0 * degree * (hour + sun.equation_of_time / 60.0);
    auto const direction = to_direction({sun.declination, angle}, latitude);
    if (std::sin(direction.altitude) > 1e-5) directions.push_back(in_single_precision(direction));
  }
  return directions;
}

// How many of the directions asked for had not been foreseen.
struct Met {
  int unforeseen = 0;
  double farthest = 0.0;  // from what was asked to what it was settled to
};

class Asked {
 public:
  explicit Asked(double latitude) : latitude_(latitude) {}

  Met go_through(std::vector<SunDirection> const& directions) {
    Met met;
    for (auto const sun : directions) {
      auto const before = foreseen.ahead();
      std::vector<SunDirection> const ahead(before.begin(), before.end());
      auto const settled = foreseen.snap_to_known(sun, [this] { return latitude_; });
      if (ahead.empty() || !(ahead.front() == settled)) ++met.unforeseen;
      met.farthest = std::max(met.farthest, apart(sun, settled));
    }
    return met;
  }

  PredictedDirections foreseen;

 private:
  double latitude_;
};

TEST(PredictedDirections, TheRestOfADayAfterItsFirstOrFirstTwo) {
  for (double const latitude : {-66.0, -35.0, 0.0, 42.0, 60.0}) {
    for (int const steps : {1, 4, 6, 60}) {
      Asked asked(latitude * degree);
      // The step is learned from the first two.
      EXPECT_EQ(asked.go_through(day(10, latitude * degree, steps)).unforeseen, 2);
      for (int const of_year : {11, 80, 172, 300}) {
        auto const met = asked.go_through(day(of_year, latitude * degree, steps));
        EXPECT_EQ(met.unforeseen, 1) << latitude << ' ' << steps << ' ' << of_year;
        EXPECT_LT(met.farthest, 1e-6);
      }
    }
  }
}

TEST(PredictedDirections, EndWithTheDay) {
  Asked asked(42.0 * degree);
  auto const winter = day(355, 42.0 * degree, 4);
  asked.go_through(winter);
  EXPECT_TRUE(asked.foreseen.ahead().empty());
  auto const settled = asked.foreseen.snap_to_known(day(172, 42.0 * degree, 4).front(),
                                                    [] { return 42.0 * degree; });
  EXPECT_EQ(asked.foreseen.ahead().size() + 1, day(172, 42.0 * degree, 4).size());
  for (auto const sun : asked.foreseen.ahead()) {
    EXPECT_GT(sun.altitude, 0.0);
    EXPECT_NEAR(to_hour_direction(sun, 42.0 * degree).declination,
                to_hour_direction(settled, 42.0 * degree).declination, 1e-12);
  }
}

// As warm-up days have it: what was answered is asked again, to the bit.
TEST(PredictedDirections, ADayThatComesBackIsSettledTheSame) {
  Asked asked(35.0 * degree);
  auto const latitude = [] { return 35.0 * degree; };
  auto const once = day(21, 35.0 * degree, 6);
  asked.go_through(once);
  std::vector<SunDirection> first;
  first.reserve(once.size());
  for (auto const sun : once) first.push_back(asked.foreseen.snap_to_known(sun, latitude));
  asked.go_through(day(22, 35.0 * degree, 6));
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(asked.foreseen.snap_to_known(once[i], latitude) == first[i]) << i;
    EXPECT_EQ(asked.foreseen.ahead().size(), once.size() - 1 - i);
  }
}

TEST(PredictedDirections, APolarDayIsForeseenPastMidnight) {
  Asked asked(80.0 * degree);
  auto const whole = day(172, 80.0 * degree, 4);
  ASSERT_EQ(whole.size(), 96U);
  EXPECT_LE(asked.go_through(whole).unforeseen, 3);
}

TEST(PredictedDirections, NoDayWhereTheSunDoesNotGoOnAsForeseen) {
  Asked asked(42.0 * degree);
  asked.go_through(day(10, 42.0 * degree, 4));
  // Only mornings, from here on.
  for (int of_year = 20; of_year < 120; ++of_year) {
    asked.go_through({day(of_year, 42.0 * degree, 4).front()});
  }
  EXPECT_TRUE(asked.foreseen.ahead().empty());
}

TEST(PredictedDirections, NoDayWithoutALatitude) {
  PredictedDirections foreseen;
  for (auto const sun : day(10, 42.0 * degree, 4)) {
    EXPECT_TRUE(foreseen.snap_to_known(sun, {}) == sun);
    EXPECT_TRUE(foreseen.ahead().empty());
  }
}

TEST(PredictedDirections, ThePatchesOfTheSky) {
  Asked asked(42.0 * degree);
  std::vector<SunDirection> sky;
  for (int altitude = 0; altitude < 6; ++altitude) {
    for (int azimuth = 0; azimuth < 24; ++azimuth) {
      // Either turn of the azimuth.
      double const degrees = 15.0 * (azimuth <= 12 ? azimuth : azimuth - 24);
      sky.push_back(in_single_precision({degrees * degree, (7.5 + 15.0 * altitude) * degree}));
    }
  }
  auto const met = asked.go_through(sky);
  EXPECT_EQ(met.unforeseen, 1);
  EXPECT_LT(met.farthest, 1e-6);
  // From each of them on, all the others.
  for (auto const sun : sky) {
    ASSERT_TRUE(is_sky_patch(sun));
    auto const settled = asked.foreseen.snap_to_known(sun, {});
    std::set<std::pair<double, double>> all{{settled.azimuth, settled.altitude}};
    for (auto const other : asked.foreseen.ahead()) all.emplace(other.azimuth, other.altitude);
    EXPECT_EQ(all.size(), 144U);
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
