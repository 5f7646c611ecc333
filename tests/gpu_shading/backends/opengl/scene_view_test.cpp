#include "gpu_shading/scene_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "each_backend.h"
#include "gpu_shading/error.h"
#include "gpu_shading/image.h"
#include "gpu_shading/transmittance.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

using Colour = std::array<int, 3>;

Colour rounded(glm::dvec3 const& colour) {
  return {static_cast<int>(std::lround(colour.x)), static_cast<int>(std::lround(colour.y)),
          static_cast<int>(std::lround(colour.z))};
}

std::map<Colour, int> count_colours(Image const& image) {
  std::map<Colour, int> counts;
  for (std::size_t at = 0; at + 2 < image.pixels.size(); at += 3) {
    ++counts[{image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]}];
  }
  return counts;
}

// A level receiver of 4 x 4 m and, over a quarter of it, a sheet.
struct Case {
  Scene scene;
  std::vector<std::optional<double>> fractions{0.75, std::nullopt};
  std::vector<SurfaceId> all{0, 1};

  explicit Case(std::shared_ptr<Transmittance const> transmittance = nullptr) {
    scene.add({"receiver", level(0, 0, 0, 4, 4)});
    Surface sheet;
    sheet.name = "sheet";
    sheet.polygon = level(1, 1, 1, 2, 2);
    if (transmittance) sheet.filter.set(AngularTransmittance{std::move(transmittance)});
    scene.add(std::move(sheet));
  }
};

class SceneViews : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, SceneViews, backends, name_of);

TEST_P(SceneViews, ShowsReceiversByTheirFractionAndOthersGrey) {
  Case const quarter;
  SceneView view(quarter.scene, quarter.all, GetParam());
  auto const image = view.draw(sun_at(180, 90), quarter.fractions, 540);
  EXPECT_EQ(image.width, 540);
  EXPECT_EQ(image.height, 540);
  auto const counts = count_colours(image);
  // 4 m and 4 % of them on each side are 540 pixels: 500 for the receiver, less its edges.
  EXPECT_NEAR(counts.at(rounded(fraction_colour(0.75))), 500 * 500 * 0.75, 3100);
  EXPECT_NEAR(counts.at({215, 215, 215}), 250 * 250, 600);
  EXPECT_NEAR(counts.at({226, 234, 243}), 540 * 540 - 500 * 500, 2100);
}

TEST_P(SceneViews, SeesThroughWhatTransmits) {
  Case const pane(std::make_shared<Transmittance const>(Transmittance::constant(0.5)));
  SceneView view(pane.scene, pane.all, GetParam());
  auto const counts = count_colours(view.draw(sun_at(180, 90), pane.fractions, 540));
  auto const both = rounded(0.5 * (fraction_colour(0.75) + glm::dvec3(215.0)));
  EXPECT_NEAR(counts.at(both), 250 * 250, 600);
  EXPECT_FALSE(counts.contains({215, 215, 215}));
}

TEST_P(SceneViews, TheNearestHidesTheOthers) {
  Case sides;
  // From the south at the horizon only a wall in front of both is seen.
  auto const wall = sides.scene.add({"wall", south_facing(-1, -1, -1, 6, 3)});
  sides.all.push_back(wall);
  sides.fractions.emplace_back(0.0);
  SceneView view(sides.scene, sides.all, GetParam());
  auto const counts = count_colours(view.draw(sun_at(180, 0), sides.fractions, 300));
  EXPECT_TRUE(counts.contains(rounded(fraction_colour(0.0))));
  EXPECT_FALSE(counts.contains(rounded(fraction_colour(0.75))));
}

TEST_P(SceneViews, FarSurfacesDoNotMakeReceiversSmall) {
  Case distant;
  auto const hill = distant.scene.add({"hill", south_facing(-5000, 9000, 0, 10000, 300)});
  distant.all.push_back(hill);
  distant.fractions.emplace_back(std::nullopt);
  SceneView view(distant.scene, distant.all, GetParam());
  auto const counts = count_colours(view.draw(sun_at(180, 60), distant.fractions, 300));
  EXPECT_GT(counts.at(rounded(fraction_colour(0.75))), 300 * 300 / 10);
}

TEST_P(SceneViews, ShowsNeighboursWhole) {
  Case beside;
  // From above, beside a receiver of 4 m: one that ends 3.8 m beside it, then one that goes far, of
  // which as much is shown as half of the receiver.
  for (double const width : {2.8, 30.0}) {
    auto const roof = beside.scene.add({"roof", level(5, 0, 0, width, 4)});
    beside.all.push_back(roof);
    beside.fractions.emplace_back(std::nullopt);
    SceneView view(beside.scene, beside.all, GetParam());
    auto const image = view.draw(sun_at(180, 90), beside.fractions, 500);
    double const metres = 7.8;  // of both receiver and roof
    EXPECT_NEAR(image.height, 500 * (4 + 0.08 * metres) / (1.08 * metres), 2.0);
  }
}

TEST_P(SceneViews, CutsOffNoTree) {
  Case beside;
  // From above, beside a receiver of 4 m: a tree nearby, one behind it that the picture would cut
  // off, and one outside of the picture.
  for (double const from : {5.0, 7.5, 13.0}) {
    Surface tree{"tree " + std::to_string(from), level(from, 0, 0, 3, 3)};
    tree.filter.set(Crown{.height = 2.0});
    beside.all.push_back(beside.scene.add(tree));
    beside.fractions.emplace_back(std::nullopt);
  }
  SceneView view(beside.scene, beside.all, GetParam());
  auto const image = view.draw(sun_at(180, 90), beside.fractions, 500);
  double const metres = 10.5;
  EXPECT_NEAR(image.height, 500 * (4 + 0.08 * metres) / (1.08 * metres), 2.0);
}

TEST_P(SceneViews, SaysWhatItCannotDraw) {
  Case const some;
  SceneView view(some.scene, some.all, GetParam());
  EXPECT_THROW(view.draw(sun_at(180, 45), {}, 300), Error);
  EXPECT_THROW(view.draw(sun_at(180, 45), some.fractions, 0), Error);
  EXPECT_THROW(SceneView(some.scene, {}, GetParam()), Error);
}

TEST(FractionColour, GrowsLighter) {
  double before = -1.0;
  for (int step = 0; step <= 20; ++step) {
    auto const colour = fraction_colour(0.05 * step);
    // Luma of ITU-R BT.601.
    double const luma = 0.299 * colour.x + 0.587 * colour.y + 0.114 * colour.z;
    EXPECT_GT(luma, before);
    before = luma;
  }
}

}  // namespace
}  // namespace gpu_shading
