#include "gpu_shading/sampled_sunlit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "gpu_shading/sun_position.h"
#include "support/degree.h"
#include "support/shaded_window.h"

namespace gpu_shading {
namespace {

using shaded_window::errors_of;
using shaded_window::receivers_of;
using shaded_window::scenes;
using shaded_window::source_of;
using shaded_window::year_of_suns;

constexpr Sampling::Density fine = Sampling::Density::fine;
constexpr Sampling::Density medium = Sampling::Density::medium;
constexpr Sampling::Density coarse = Sampling::Density::coarse;

// Answers of receivers (unit normals, 1 m2) by a function of the direction.
SunlitSource fraction_source(std::vector<glm::dvec3> const& normals,
                             std::function<double(SunDirection)> const& fraction) {
  return [normals, fraction](std::span<SunDirection const> directions) {
    std::vector<std::vector<Sunlit>> answers;
    for (auto const sun : directions) {
      auto& row = answers.emplace_back();
      for (auto const& normal : normals) {
        double const cosine = std::max(0.0, glm::dot(normal, to_vector(sun)));
        row.push_back({cosine * fraction(sun), {}});
      }
    }
    return answers;
  };
}

std::vector<glm::dvec3> const sides{{0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};

TEST(SampledSunlit, KeepsToTheBudgetAndAboveTheHorizon) {
  for (double const latitude : {-90.0, -66.6, -35.0, 0.0, 10.0, 66.5, 80.0, 90.0}) {
    for (auto const density : {medium, coarse}) {
      auto const source = fraction_source(sides, [](SunDirection sun) { return sun.altitude / 2; });
      SampledSunlit const sampled({density, false}, latitude * degree, sides, source);
      auto const& directions = sampled.directions();
      EXPECT_LE(directions.size(), max_directions(density)) << latitude;
      EXPECT_GE(directions.size(), usual_directions(density) - 2) << latitude;
      std::set<std::pair<double, double>> distinct;
      for (auto const sun : directions) {
        EXPECT_GE(sun.altitude, 0.0) << latitude;
        EXPECT_TRUE(in_suns_range(sun, latitude * degree));
        distinct.insert({sun.azimuth, sun.altitude});
      }
      EXPECT_EQ(distinct.size(), directions.size()) << latitude;
    }
  }
}

TEST(SampledSunlit, HasNoMoreDirectionsThanThePapersGridAt42North) {
  auto const source = fraction_source(sides, [](SunDirection) { return 1.0; });
  for (auto const density : {fine, medium, coarse}) {
    SampledSunlit const paper({density, true}, 42 * degree, sides, source);
    EXPECT_LE(usual_directions(density), paper.directions().size());
    EXPECT_GE(usual_directions(density) + 2, paper.directions().size());
  }
}

TEST(SampledSunlit, UnshadedIsWholeEverywhere) {
  auto const source = fraction_source(sides, [](SunDirection) { return 1.0; });
  for (double const latitude : {0.0, 42.0, 80.0, -35.0}) {
    for (bool const paper : {false, true}) {
      SampledSunlit const sampled({coarse, paper}, latitude * degree, sides, source);
      for (auto const sun : year_of_suns(latitude * degree, 30)) {
        auto const answers = sampled.at(sun);
        for (std::size_t i = 0; i < sides.size(); ++i) {
          double const cosine = std::max(0.0, glm::dot(sides[i], to_vector(sun)));
          // At the equator the paper's grid has no direction that a side sees for weeks.
          if (paper && latitude == 0.0) continue;
          EXPECT_NEAR(answers[i].projected_area, cosine, 1e-9);
        }
      }
    }
  }
}

TEST(SampledSunlit, IsExactAtItsSamples) {
  auto const& windows = scenes()[1].windows;
  SampledSunlit const sampled({coarse, false}, 42 * degree, receivers_of(windows),
                              source_of(windows));
  for (auto const sun : sampled.directions()) {
    auto const answers = sampled.at(sun);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      if (windows[i].cosine(sun) < 0.003) continue;
      double const area = windows[i].width * windows[i].height * windows[i].cosine(sun);
      EXPECT_NEAR(answers[i].projected_area, area * windows[i].sunlit_fraction(sun), 1e-6);
    }
  }
}

// Blind to all that is smooth: every direction at random.
double noise(SunDirection sun) {
  double const x = std::sin(sun.azimuth * 12989.8 + sun.altitude * 78233.0) * 43758.5453;
  return x - std::floor(x);
}

TEST(SampledSunlit, StaysWithinNothingAndTheCosine) {
  for (double const latitude : {0.0, 42.0, 66.5, 80.0, -35.0}) {
    for (bool const paper : {false, true}) {
      SampledSunlit const sampled({coarse, paper}, latitude * degree, sides,
                                  fraction_source(sides, noise));
      for (auto const sun : year_of_suns(latitude * degree, 12)) {
        auto const answers = sampled.at(sun);
        for (std::size_t i = 0; i < sides.size(); ++i) {
          double const cosine = std::max(0.0, glm::dot(sides[i], to_vector(sun)));
          EXPECT_GE(answers[i].projected_area, 0.0);
          EXPECT_LE(answers[i].projected_area, cosine * (1 + 1e-12));
        }
      }
    }
  }
}

TEST(SampledSunlit, TakesTwiceAsManyIfAReceiverNeedsThem) {
  for (auto const density : {medium, coarse}) {
    SampledSunlit const sampled({density, false}, 42 * degree, sides,
                                fraction_source(sides, noise));
    EXPECT_LE(sampled.directions().size(), max_directions(density));
    EXPECT_GE(sampled.directions().size(), max_directions(density) - 6);
  }
}

TEST(SampledSunlit, RefinesWhereOneOfManyReceiversDisagrees) {
  // 30 windows to the south without shades, and one to the north between slats.
  constexpr std::size_t plain = 30;
  shaded_window::Window north{3.0, 1.5, 0.0, {}};
  for (int i = 0; i < 12; ++i) {
    north.casters.push_back(
        shaded_window::Rectangle{0.4, 0.5 * i - 1.5, 0.5 * i - 1.25, -5.0, 5.0});
  }
  std::vector<shaded_window::Window> windows(plain, {3.0, 1.5, 180 * degree, {}});
  windows.push_back(north);
  SampledSunlit const sampled({medium, false}, 42 * degree, receivers_of(windows),
                              source_of(windows));
  auto const& directions = sampled.directions();
  auto const lit = std::count_if(directions.begin(), directions.end(),
                                 [&](SunDirection sun) { return north.cosine(sun) > 0.0; });
  // As many as a fifth of the sun's directions face it, and most of those that were added.
  EXPECT_GT(lit, static_cast<std::ptrdiff_t>(directions.size() / 2));
  // Half of this with the directions spread evenly.
  std::vector<shaded_window::Window> const alone{north};
  SampledSunlit const spread = sampled.with(receivers_of(alone), source_of(alone));
  EXPECT_LT(errors_of(spread, alone, year_of_suns(42 * degree, 7)).mean, 5e-3);
}

TEST(SampledSunlit, TogetherSchedulesPassNoMoreThanTheCosine) {
  // All of the beam, parted at random among none, one and two scheduled shades.
  auto const source = [](std::span<SunDirection const> directions) {
    std::vector<std::vector<Sunlit>> answers;
    for (auto const sun : directions) {
      double const a = noise(sun);
      double const b = noise({sun.altitude, sun.azimuth}) * (1.0 - a);
      double const whole = std::sin(sun.altitude);
      answers.push_back({{whole * a, {{{{0, 1}}, whole * b}, {{{0, 2}}, whole * (1.0 - a - b)}}}});
    }
    return answers;
  };
  SampledSunlit const sampled({coarse, false}, 42 * degree, {{0, 0, 1}}, source);
  std::vector<double> const open{1.0};
  for (auto const sun : year_of_suns(42 * degree, 5)) {
    EXPECT_LE(sampled.at(sun)[0].at(open), std::sin(sun.altitude) * (1 + 1e-12));
  }
}

TEST(SampledSunlit, JumpsStaySharp) {
  // Lit in the morning alone: between samples at least it cannot be told when noon is.
  auto const morning = [](SunDirection sun) { return sun.azimuth < 180 * degree ? 1.0 : 0.0; };
  std::vector<glm::dvec3> const roof{{0, 0, 1}};
  SampledSunlit const sampled({medium, false}, 42 * degree, roof, fraction_source(roof, morning));
  double away_from_noon = 0.0;
  double error = 0.0;
  double count = 0.0;
  for (auto const sun : year_of_suns(42 * degree, 7)) {
    double const got = sampled.at(sun)[0].projected_area / std::sin(sun.altitude);
    double const miss = std::abs(got - morning(sun));
    error += miss;
    count += 1.0;
    double const hour_angle = to_hour_direction(sun, 42 * degree).hour_angle;
    if (std::abs(hour_angle) > 12 * degree) away_from_noon = std::max(away_from_noon, miss);
  }
  EXPECT_LT(error / count, 0.01);
  EXPECT_LT(away_from_noon, 0.1);
  // Where samples disagree there are more of them than anywhere else.
  auto const near_noon = [](SampledSunlit const& some) {
    auto const& all = some.directions();
    return std::count_if(all.begin(), all.end(), [](SunDirection sun) {
      return std::abs(to_hour_direction(sun, 42 * degree).hour_angle) < 6 * degree;
    });
  };
  SampledSunlit const even({medium, false}, 42 * degree, roof,
                           fraction_source(roof, [](SunDirection) { return 1.0; }));
  EXPECT_GT(near_noon(sampled), 3 * near_noon(even));
}

TEST(SampledSunlit, KeepsSchedulesApart) {
  auto const& windows = scenes()[0].windows;
  SampledSunlit const opaque({medium, false}, 42 * degree, receivers_of(windows),
                             source_of(windows));
  // What the shades stop passes schedule 1.
  SampledSunlit const scheduled({medium, false}, 42 * degree, receivers_of(windows),
                                source_of(windows, 1));
  std::vector<double> const open{0.0, 1.0};
  std::vector<double> const shut{1.0, 0.0};
  std::vector<double> const half{1.0, 0.5};
  for (auto const sun : year_of_suns(42 * degree, 30)) {
    auto const with = scheduled.at(sun);
    auto const without = opaque.at(sun);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      double const whole = windows[i].width * windows[i].height * windows[i].cosine(sun);
      EXPECT_NEAR(with[i].at(open), whole, 0.02 * whole + 1e-9);
      EXPECT_LE(with[i].at(open), whole * (1 + 1e-12));
      EXPECT_NEAR(with[i].at(shut), without[i].projected_area, 0.12 * whole + 1e-9);
      EXPECT_NEAR(with[i].at(half), 0.5 * (with[i].at(open) + with[i].at(shut)), 1e-12);
    }
  }
}

TEST(SampledSunlit, SaysOfWhatItKnowsNothing) {
  std::vector<glm::dvec3> const floor{{0, 0, -1}, {0, 0, 0}, {0, -2, 0}};
  SampledSunlit const sampled({coarse, false}, 42 * degree, floor,
                              fraction_source(floor, [](SunDirection) { return 1.0; }));
  EXPECT_FALSE(sampled.knows(0));
  EXPECT_FALSE(sampled.knows(1));
  EXPECT_TRUE(sampled.knows(2));
  auto const answers = sampled.at({180 * degree, 30 * degree});
  EXPECT_EQ(answers[0].projected_area, 0.0);
  EXPECT_EQ(answers[1].projected_area, 0.0);
  EXPECT_NEAR(answers[2].projected_area, 2 * std::cos(30 * degree), 1e-9);
}

TEST(SampledSunlit, TellsTheSunsDirectionsFromOthers) {
  double const latitude = 42 * degree;
  for (auto const sun : year_of_suns(latitude, 1)) EXPECT_TRUE(in_suns_range(sun, latitude));
  EXPECT_FALSE(in_suns_range({180 * degree, -0.01}, latitude));
  EXPECT_FALSE(in_suns_range({180 * degree, 72 * degree}, latitude));
  EXPECT_FALSE(in_suns_range({0.0, 30 * degree}, latitude));
  EXPECT_FALSE(in_suns_range({180 * degree, 24 * degree}, latitude));
  EXPECT_TRUE(in_suns_range({0.0, 40 * degree}, -35 * degree));
  EXPECT_TRUE(in_suns_range({1.0, 20 * degree}, 90 * degree));
}

class ClosedForms : public testing::TestWithParam<double> {};

TEST_P(ClosedForms, MediumIsWithinWhatIsWantedAndAThirdOfThePapersGrid) {
  double const latitude = GetParam() * degree;
  auto const suns = year_of_suns(latitude, 7);
  for (auto const& scene : scenes()) {
    auto const errors = [&](bool paper) {
      return errors_of(SampledSunlit({medium, paper}, latitude, receivers_of(scene.windows),
                                     source_of(scene.windows)),
                       scene.windows, suns);
    };
    auto const ours = errors(false);
    EXPECT_LT(ours.worst, scene.wanted_mean) << scene.name;
    EXPECT_LT(ours.beam, scene.wanted_beam) << scene.name;
    EXPECT_LT(ours.mean, errors(true).mean / 3.0) << scene.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Latitudes, ClosedForms, testing::Values(0.0, 42.0, 66.5, 80.0, -35.0));

TEST(PaperGrid, IsPoorAsItWasFound) {
  // Mean errors at 42 N, windows to the south: 0.0096 (overhang and fin), 0.019 (a neighbour),
  // 0.013 (louvres) and 0.024 (slats) were found on other scenes of these kinds.
  auto const suns = year_of_suns(42 * degree, 7);
  std::array<double, 4> const found{0.0096, 0.019, 0.013, 0.024};
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::vector<shaded_window::Window> const south{scenes()[i].windows.front()};
    SampledSunlit const paper({medium, true}, 42 * degree, receivers_of(south), source_of(south));
    double const mean = errors_of(paper, south, suns).mean;
    EXPECT_GT(mean, found[i] / 3) << scenes()[i].name;
    EXPECT_LT(mean, found[i] * 3) << scenes()[i].name;
  }
}

TEST(PaperGrid, CollapsesAtTheEquator) {
  auto const& scene = scenes()[0];
  auto const suns = year_of_suns(0.0, 7);
  SampledSunlit const paper({medium, true}, 0.0, receivers_of(scene.windows),
                            source_of(scene.windows));
  EXPECT_GT(errors_of(paper, scene.windows, suns).beam, 0.5);
}

}  // namespace
}  // namespace gpu_shading
