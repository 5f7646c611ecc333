#include "sun/sampling/sunlit_splines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "gpu_shading/sun_position.h"
#include "sun/sampling/fraction_levels.h"
#include "sun/sampling/sun_arcs.h"

namespace gpu_shading {
namespace {

constexpr double latitude = 42.0 * std::numbers::pi / 180.0;

using Purpose = SunlitSplines::Purpose;
using Fraction = std::function<double(glm::dvec3 const& towards_sun)>;

SunlitTable table_of(glm::dvec3 const& normal, Fraction const& fraction) {
  std::vector<SunDirection> directions;
  std::vector<std::vector<Sunlit>> answers;
  for (auto const hour : spread_on_arcs(latitude, 200)) {
    directions.push_back(to_direction(hour, latitude));
    auto const sun = to_vector(directions.back());
    answers.push_back({{std::max(glm::dot(normal, sun), 0.0) * fraction(sun), {}}});
  }
  SunlitTable table({normal});
  table.add(directions, answers);
  return table;
}

// Between the samples.
double mean_error(glm::dvec3 const& normal, Fraction const& fraction) {
  auto const table = table_of(normal, fraction);
  SunlitSplines const splines(table, Purpose::refinement);
  double sum = 0.0;
  int count = 0;
  for (auto const hour : spread_on_arcs(latitude, 3000)) {
    auto const direction = to_direction(hour, latitude);
    auto const sun = to_vector(direction);
    if (!table.faces(0, sun)) continue;
    sum += std::abs(splines.at(direction).front() - fraction(sun));
    ++count;
  }
  return sum / count;
}

double mean(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(SunlitSplines, MissAsAnswersDoWhichStayWithinNothingAndWhole) {
  // Lit in the morning alone: beside noon splines swing beyond 0 and 1, answers do not.
  auto const table =
      table_of({0, 0, 1}, [](glm::dvec3 const& sun) { return sun.x > 0.0 ? 1.0 : 0.0; });
  auto const missed = SunlitSplines(table, Purpose::refinement).misses(table).front();
  EXPECT_GT(std::count(missed.begin(), missed.end(), 0.0), 60);
  EXPECT_GT(*std::max_element(missed.begin(), missed.end()), 0.3);
  EXPECT_LE(*std::max_element(missed.begin(), missed.end()), 1.0);
}

TEST(SunlitSplines, TellEachFractionByWhatItFollows) {
  glm::dvec3 const south{0, -1, 0};
  // As behind louvres: by how far shadows fall. Over directions 0.0035.
  auto const louvres = [](glm::dvec3 const& sun) { return 1.0 / (1.0 - sun.z / sun.y); };
  EXPECT_LT(mean_error(south, louvres), 2.5e-3);
  // By direction, near grazing sun too. Over shadows 0.0025.
  auto const wave = [](glm::dvec3 const& sun) { return 0.5 + 0.4 * std::sin(3.0 * sun.x); };
  EXPECT_LT(mean_error(south, wave), 8e-4);
}

TEST(SunlitSplines, KeepKinksAtTheTransmittanceOfAShade) {
  // Two shades pass a window in turn, before one another in between: each transmits a tenth.
  auto const shaded = [](double from, double to, double at) {
    return std::clamp(std::min(at - from, to - at) / 0.3, 0.0, 1.0);
  };
  auto const fraction = [&](double transmittance) {
    return [=](glm::dvec3 const& sun) {
      double const open = 1.0 - transmittance;
      return (1.0 - open * shaded(-1.0, 0.4, sun.x)) * (1.0 - open * shaded(-0.4, 0.8, sun.x));
    };
  };
  glm::dvec3 const up{0, 0, 1};
  double const error = mean_error(up, fraction(0.1));
  // As much beam is stopped as by opaque shades, as accurately.
  EXPECT_LT(error, 1.1 * mean_error(up, fraction(0.0)));
  EXPECT_LT(error, 6e-3);
}

TEST(SunlitSplines, DoubtWhereTheyAreWrong) {
  glm::dvec3 const up{0, 0, 1};
  auto const edge = [](glm::dvec3 const& sun) { return std::clamp(0.5 + 3.0 * sun.x, 0.0, 1.0); };
  auto const table = table_of(up, edge);
  SunlitSplines const splines(table, Purpose::refinement);
  std::vector<double> where_wrong;
  std::vector<double> where_right;
  for (auto const hour : spread_on_arcs(latitude, 3000)) {
    auto const direction = to_direction(hour, latitude);
    double const wrong = std::abs(splines.at(direction).front() - edge(to_vector(direction)));
    (wrong > 0.01 ? where_wrong : where_right).push_back(splines.uncertainty(direction).front());
  }
  ASSERT_GT(where_wrong.size(), 50U);
  EXPECT_GT(mean(where_wrong), 5.0 * mean(where_right));
  EXPECT_GT(mean(where_wrong), 0.003);
}

TEST(FractionLevels, AreThoseThatManySamplesShare) {
  std::vector<double> fractions{0.25, 0.41, 0.73, 0.9};
  EXPECT_EQ(fraction_levels(fractions), (std::vector<double>{0.0, 1.0}));
  fractions.insert(fractions.end(), 5, 0.5);
  EXPECT_EQ(fraction_levels(fractions), (std::vector<double>{0.0, 0.5, 1.0}));
  fractions.insert(fractions.end(), 6, 0.0625);
  EXPECT_EQ(fraction_levels(fractions), (std::vector<double>{0.0625, 0.5, 1.0}));
  fractions.insert(fractions.end(), 5, 0.999);
  EXPECT_EQ(fraction_levels(fractions), (std::vector<double>{0.0625, 0.5, 1.0}));
  fractions.push_back(0.0);
  EXPECT_EQ(fraction_levels(fractions), (std::vector<double>{0.0, 0.0625, 0.5, 1.0}));
  // Those of most samples.
  for (int i = 1; i < 9; ++i) fractions.insert(fractions.end(), i < 4 ? 5 : 6, 0.1 * i + 0.05);
  EXPECT_EQ(fraction_levels(fractions).size(), 7U);
  EXPECT_EQ(fraction_levels(std::vector<double>(8, 1.0)), (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(fraction_levels(std::vector<double>(8, 0.25)), (std::vector<double>{0.25, 1.0}));
}

}  // namespace
}  // namespace gpu_shading
