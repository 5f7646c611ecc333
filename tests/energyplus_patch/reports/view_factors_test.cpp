#include "reports/view_factors.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>
#include <numeric>
#include <vector>

namespace gpu_shading::energyplus {
namespace {

constexpr int rays = 1 << 16;

Surface rectangle(Ring outline) {
  Surface surface;
  surface.polygon.outline = std::move(outline);
  return surface;
}

// From a point of a scene, by surface.
ViewFactors views(Scene const& scene, MaskPoints const& points,
                  std::optional<SurfaceId> receiver = std::nullopt) {
  RayScene const traced(scene);
  std::vector<std::size_t> groups(scene.size());
  std::iota(groups.begin(), groups.end(), std::size_t{viewed_surfaces});
  return trace_view_factors(traced, {.receiver = receiver}, groups, scene.size() + viewed_surfaces,
                            points, rays);
}

// From an element to a parallel rectangle of a x b at distance c, with a corner above the element
// (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3).
double to_quarter(double a, double b, double c) {
  double const x = a / c;
  double const y = b / c;
  double const s = std::sqrt(1 + x * x);
  double const t = std::sqrt(1 + y * y);
  return (x / s * std::atan(y / s) + y / t * std::atan(x / t)) / (2 * std::numbers::pi);
}

TEST(ViewFactors, CanopyWithAHoleIsThatOfTheClosedForm) {
  auto canopy = rectangle({{-4, -3, 2}, {4, -3, 2}, {4, 3, 2}, {-4, 3, 2}});
  canopy.polygon.holes.push_back({{-1, -0.5, 2}, {-1, 0.5, 2}, {1, 0.5, 2}, {1, -0.5, 2}});
  Scene scene;
  scene.add(std::move(canopy));
  auto const found = views(scene, point_at({0, 0, 0}, {0, 0, 1}));
  double const expected = 4 * (to_quarter(4, 3, 2) - to_quarter(1, 0.5, 2));
  EXPECT_NEAR(found.factors[viewed_surfaces], expected, 0.001);
  EXPECT_NEAR(found.factors[viewed_sky], 1.0 - expected, 0.001);
  EXPECT_EQ(found.factors[viewed_ground], 0.0);
  EXPECT_LT(found.error, 0.001);
  EXPECT_LT(std::abs(found.factors[viewed_surfaces] - expected), 4 * found.error + 1e-9);
}

// A1 F12 of rectangles in two planes at right angles: x and y on the first, eta and xi on the
// second, y and eta along the planes' line, x and xi away from it (Howell, C-15).
double between(glm::dvec2 x, glm::dvec2 y, glm::dvec2 eta, glm::dvec2 xi) {
  double sum = 0.0;
  for (int corner = 0; corner < 16; ++corner) {
    auto const end = [&](glm::dvec2 const& range, int bit) { return range[(corner >> bit) & 1]; };
    double const square = std::pow(end(x, 0), 2) + std::pow(end(xi, 1), 2);
    double const along = end(y, 2) - end(eta, 3);
    double const term = along * std::sqrt(square) * std::atan(along / std::sqrt(square)) -
                        0.25 * (square - along * along) * std::log(square + along * along);
    sum += std::popcount(static_cast<unsigned>(corner)) % 2 == 0 ? term : -term;
  }
  return sum / (2 * std::numbers::pi);
}

TEST(ViewFactors, AreReciprocal) {
  // Of different sizes, and at right angles.
  Scene scene;
  auto const small = scene.add(rectangle({{0, 0, 0}, {2, 0, 0}, {2, 0, 3}, {0, 0, 3}}));
  auto const large = scene.add(rectangle({{-1, -9, 0}, {-1, -1, 0}, {-1, -1, 5}, {-1, -9, 5}}));
  auto const from = [&](SurfaceId id) {
    return views(scene, points_of(scene[id].polygon, 256), id);
  };
  auto const there = from(small);
  auto const back = from(large);
  double const expected = between({1, 3}, {0, 3}, {0, 5}, {1, 9});
  EXPECT_NEAR(expected, 1.16918, 1e-5);  // by numeric integration
  EXPECT_NEAR(6.0 * there.factors[viewed_surfaces + large], expected, 6.0 * 3.0 * there.error);
  EXPECT_NEAR(40.0 * back.factors[viewed_surfaces + small], expected, 40.0 * 3.0 * back.error);
  EXPECT_LT(there.error, 0.001);
  EXPECT_LT(back.error, 0.001);
}

TEST(ViewFactors, OfACubeFromInsideAreKnown) {
  // Opposite and adjacent faces of a cube: 0.19982 and 0.20004.
  Scene scene;
  scene.add(rectangle({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}));
  scene.add(rectangle({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}));
  Polygon const floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  auto const found = views(scene, points_of(floor, 256)).factors;
  EXPECT_NEAR(found[viewed_surfaces], 0.19982, 0.001);
  EXPECT_NEAR(found[viewed_surfaces + 1], 0.20004, 0.001);
}

TEST(ViewFactors, AreTheSameInEveryRun) {
  Scene scene;
  scene.add(rectangle({{0, -3, 0}, {5, -3, 0}, {5, -3, 4}, {0, -3, 4}}));
  auto const points = point_at({0, 0, 1}, {0, -1, 0});
  EXPECT_EQ(views(scene, points).factors, views(scene, points).factors);
}

TEST(ViewFactors, MillionthsAddUp) {
  auto const rounded = in_millionths({1.0 / 3, 1.0 / 3, 1.0 / 3, 0.0});
  EXPECT_EQ(std::accumulate(rounded.begin(), rounded.end(), 0), 1'000'000);
  EXPECT_EQ(rounded.back(), 0);
}

TEST(ViewFactors, EnergyPlusNeverFindsASumOverOne) {
  for (int sky = 1; sky < 1'000'000; sky += 31'337) {
    auto const editor = edit_epjson(nlohmann::json::object());
    int const walls = (1'000'000 - sky) / 3;
    auto const cut_off =
        add_local_environments(*editor, {{"SKY"}, {"GROUND"}, {"WALLS", "WARM"}, {"TREES", "COOL"}},
                               {{"FACE", {sky, 0, walls, 1'000'000 - sky - walls}, 0.5}});
    auto const json = nlohmann::json::parse(editor->text());
    auto const& views =
        json.at("SurfaceProperty:SurroundingSurfaces").at("GPU SHADING VIEWS OF FACE");
    double sum = views.at("sky_view_factor");
    for (auto const& each : views.at("surfaces")) {
      sum += each.at("surrounding_surface_view_factor").get<double>();
    }
    EXPECT_LE(sum, 1.0);
    EXPECT_GT(sum, 1.0 - 2.5e-6);
    EXPECT_EQ(cut_off.size(), sky > 10'000 ? 1U : 0U) << sky;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
