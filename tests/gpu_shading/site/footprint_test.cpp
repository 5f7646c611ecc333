#include "gpu_shading/footprint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

using testing::HasSubstr;

// Corners in metres about a place.
GeographicRing ring_about(GeographicPoint const& place,
                          std::vector<std::pair<double, double>> const& corners) {
  LocalAxes const axes({place.latitude, place.longitude, 0.0});
  GeographicRing ring;
  for (auto const& [x, y] : corners) ring.push_back(axes.to_geographic({x, y, 0.0}));
  return ring;
}

GeographicPoint const town{52.5, 13.4, 35.0};
std::vector<std::pair<double, double>> const rectangle{{10, 20}, {40, 20}, {40, 30}, {10, 30}};
std::vector<std::pair<double, double>> const court{{15, 22}, {25, 22}, {25, 28}, {15, 28}};

double total_area(std::vector<Polygon> const& faces) {
  double sum = 0.0;
  for (auto const& face : faces) sum += area(face);
  return sum;
}

TEST(UprightPrism, RoofAndWallsFaceOutwards) {
  LocalAxes const axes(town);
  Footprint house{ring_about(town, rectangle), {}, 35.0, 50.0};
  for (bool const reversed : {false, true}) {
    if (reversed) std::reverse(house.outline.begin(), house.outline.end());
    auto const faces = upright_prism(house, axes);
    ASSERT_EQ(faces.size(), 5U);
    // 30 x 10 m: the ellipsoid's height of 35 m stretches them by 35 m over the earth's radius.
    EXPECT_NEAR(area(faces[0]), 300.0, 0.01);
    EXPECT_NEAR(total_area(faces), 300.0 + 2 * 15.0 * (30 + 10), 0.1);
    EXPECT_NEAR(normal(faces[0]).z, 1.0, 1e-9);
    glm::dvec3 const middle(25, 25, 7.5);
    for (std::size_t i = 1; i < faces.size(); ++i) {
      EXPECT_NEAR(normal(faces[i]).z, 0.0, 1e-4);
      EXPECT_GT(glm::dot(normal(faces[i]), faces[i].outline[0] - middle), 0.0) << i;
      for (auto const& corner : faces[i].outline) {
        EXPECT_NEAR(std::min(std::abs(corner.z), std::abs(corner.z - 15.0)), 0.0, 1e-3);
      }
    }
  }
}

TEST(UprightPrism, CourtyardsStayOpen) {
  LocalAxes const axes(town);
  Footprint const house{ring_about(town, rectangle), {ring_about(town, court)}, 35.0, 50.0};
  auto const faces = upright_prism(house, axes);
  ASSERT_EQ(faces.size(), 1U + 4U + 4U);
  EXPECT_EQ(faces[0].holes.size(), 1U);
  EXPECT_NEAR(area(faces[0]), 300.0 - 60.0, 0.01);
  glm::dvec3 const middle_of_court(20, 25, 7.5);
  for (std::size_t i = 5; i < faces.size(); ++i) {
    EXPECT_LT(glm::dot(normal(faces[i]), faces[i].outline[0] - middle_of_court), 0.0) << i;
  }
}

TEST(UprightPrism, AcrossTheAntimeridianStaysAsWideAsItIs) {
  GeographicPoint const place{-16.8, 180.0, 0.0};
  LocalAxes const axes({-16.8, 179.999, 0.0});
  Footprint house{ring_about(place, {{-50, -5}, {50, -5}, {50, 5}, {-50, 5}}), {}, 0.0, 10.0};
  EXPECT_LT(house.outline[1].longitude * house.outline[0].longitude, 0.0) << "not on both sides";
  auto const near = upright_prism(house, axes);
  EXPECT_NEAR(area(near[0]), 1000.0, 0.01);
  for (auto& corner : house.outline) {
    if (corner.longitude < 0.0) corner.longitude += 360.0;
  }
  auto const same = upright_prism(house, axes);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(glm::distance(near[0].outline[i], same[0].outline[i]), 0.0, 1e-6);
    EXPECT_LT(glm::length(near[0].outline[i]), 170.0);
  }
}

TEST(UprightPrism, RoundThePole) {
  LocalAxes const axes({-90.0, 0.0, 0.0});
  Footprint house{{}, {}, 0.0, 10.0};
  // A square whose corners are 100 m from the pole.
  double const down = 100.0 / 111693.98;  // metres a degree of latitude there (Snyder 1987, p. 24)
  for (double const longitude : {0.0, 90.0, 180.0, 270.0}) {
    house.outline.push_back({-90.0 + down, longitude, 0.0});
  }
  auto const faces = upright_prism(house, axes);
  ASSERT_EQ(faces.size(), 5U);
  EXPECT_NEAR(area(faces[0]), 20000.0, 0.1);
  EXPECT_TRUE(covers(faces[0], {0.0, 0.0, 0.0}));
}

TEST(UprightPrism, FarAwayItLeansOutwardsAndSinks) {
  LocalAxes const axes({45.0, 10.0, 0.0});
  auto const place = axes.to_geographic({30000.0, 0.0, 0.0});
  Footprint const tower{ring_about(place, {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}), {}, 0.0, 100.0};
  auto const faces = upright_prism(tower, axes);
  auto const& wall = faces[1].outline;
  EXPECT_NEAR(wall[1].z, -70.6, 0.6);
  glm::dvec3 const up = glm::normalize(wall[0] - wall[1]);
  EXPECT_NEAR(up.x, 30000.0 / 6.38e6, 5e-5);
}

TEST(UprightPrism, RefusesWhatIsNoBuilding) {
  LocalAxes const axes(town);
  auto const refusal = [&](Footprint const& footprint) -> std::string {
    try {
      upright_prism(footprint, axes);
    } catch (Error const& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal({ring_about(town, {{0, 0}, {10, 10}, {10, 0}, {0, 10}}), {}, 0, 1}),
              HasSubstr("crosses itself"));
  EXPECT_THAT(refusal({ring_about(town, {{0, 0}, {10, 0}}), {}, 0, 1}), HasSubstr("2 corners"));
  EXPECT_THAT(refusal({{}, {}, 0, 1}), HasSubstr("0 corners"));
  EXPECT_THAT(refusal({ring_about(town, rectangle), {}, 5, 5}), HasSubstr("not above its base"));
  EXPECT_THAT(refusal({ring_about(town, rectangle), {}, 5, std::nan("")}),
              HasSubstr("not above its base"));
  EXPECT_THAT(refusal({ring_about(town, court), {ring_about(town, rectangle)}, 0, 1}),
              HasSubstr("not inside"));
  EXPECT_THAT(refusal({ring_about(town, {{0, 0}, {10, 0}, {20, 0}}), {}, 0, 1}),
              HasSubstr("no area"));
}

TEST(UprightPrism, RepeatedCornersAreOne) {
  LocalAxes const axes(town);
  Footprint house{ring_about(town, rectangle), {}, 0.0, 3.0};
  house.outline.insert(house.outline.begin() + 2, house.outline[1]);
  house.outline.push_back(house.outline.front());
  EXPECT_EQ(upright_prism(house, axes).size(), 5U);
}

TEST(Covers, CourtyardsAndOtherPlacesAreNot) {
  LocalAxes const axes({town.latitude, town.longitude, 0.0});
  auto const roof =
      upright_prism({ring_about(town, rectangle), {ring_about(town, court)}, 35.0, 50.0}, axes)[0];
  EXPECT_TRUE(covers(roof, {12, 25, 0}));
  EXPECT_FALSE(covers(roof, {20, 25, 0}));
  EXPECT_FALSE(covers(roof, {5, 25, 0}));
}

}  // namespace
}  // namespace gpu_shading
