#include "solar/sunlit_splines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "gpu_shading/sun_position.h"
#include "solar/sun_arcs.h"

namespace gpu_shading {
namespace {

constexpr double latitude = 42.0 * std::numbers::pi / 180.0;

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
  SunlitSplines const splines(table);
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

TEST(SunlitSplines, MissAsAnswersDoWhichStayWithinNothingAndWhole) {
  // Lit in the morning alone: beside noon splines swing beyond 0 and 1, answers do not.
  auto const table =
      table_of({0, 0, 1}, [](glm::dvec3 const& sun) { return sun.x > 0.0 ? 1.0 : 0.0; });
  auto const missed = SunlitSplines(table).misses(table).front();
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

}  // namespace
}  // namespace gpu_shading
