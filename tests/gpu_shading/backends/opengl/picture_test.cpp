#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "each_backend.h"
#include "gpu_shading/error.h"
#include "support/exact.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

using Colour = std::array<int, 3>;
// The ends of cividis.
constexpr Colour yellow{254, 232, 56};
constexpr Colour blue{0, 34, 78};

Colour colour_at(Image const& image, int column, int row) {
  auto const at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(column));
  return {image.pixels.at(at), image.pixels.at(at + 1), image.pixels.at(at + 2)};
}

int count(Image const& image, Colour const& wanted) {
  int found = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      if (colour_at(image, column, row) == wanted) ++found;
    }
  }
  return found;
}

class SunView : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, SunView, backends, name_of);

TEST_P(SunView, YellowAndBlueAreTheSunlitShare) {
  int seen = 0;
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    RandomScene const random = random_scene(seed);
    Renderer renderer = renderer_of(random.scene);
    Image const image = renderer.sun_view(random.sun, 0, 600);
    double const lit = count(image, yellow);
    double const shaded = count(image, blue);
    // Seen very flat, a receiver has few pixels in the sun's own view.
    if (lit + shaded < 10000) continue;
    ++seen;
    double const whole = exact::projected_area(random.scene, random.sun, 0);
    double const exact = exact::projected_sunlit_area(random.scene, random.sun, 0) / whole;
    EXPECT_NEAR(lit / (lit + shaded), exact, 0.01) << "seed " << seed;
  }
  EXPECT_GT(seen, 15);
}

TEST_P(SunView, WorldUpIsUpAndEastIsOnTheRightOfASouthFacade) {
  // From the south one looks north: east is on the right. The overhang shades the top, the fin in
  // the east the right.
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 3)});
  scene.add({"overhang", level(-1, -0.5, 3, 5, 0.5)});
  Renderer over = renderer_of(scene);
  Image const image = over.sun_view(sun_at(180, 30), 0, 400);
  EXPECT_EQ(image.width, 400);
  EXPECT_LT(image.height, 400);  // seen from 30 degrees above, less tall than wide
  EXPECT_EQ(colour_at(image, 200, image.height * 3 / 4), yellow);
  EXPECT_EQ(colour_at(image, 200, image.height * 3 / 20), blue);

  Scene fins;
  fins.add({"window", south_facing(0, 0, 0, 3, 3)});
  fins.add({"fin", parallelogram({3, 0, -1}, {0, -1, 0}, {0, 0, 5})});
  Renderer beside = renderer_of(fins);
  Image const morning = beside.sun_view(sun_at(140, 10), 0, 400);
  EXPECT_EQ(colour_at(morning, morning.width * 4 / 5, morning.height / 2), blue);
  EXPECT_EQ(colour_at(morning, morning.width / 4, morning.height / 2), yellow);
}

TEST_P(SunView, ZenithHasNorthUp) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add({"canopy over the north half", level(-1, 2, 3, 6, 3)});
  Renderer renderer = renderer_of(scene);
  Image const image = renderer.sun_view({}, 0, 200);
  EXPECT_EQ(colour_at(image, 100, 60), blue);
  EXPECT_EQ(colour_at(image, 100, 140), yellow);
}

TEST_P(SunView, CastersAroundTheReceiverAreGrey) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add({"ground", level(-50, -50, -1, 100, 100)});
  Renderer renderer = renderer_of(scene);
  Image const image = renderer.sun_view(sun_at(180, 60), 0, 200);
  Colour const corner = colour_at(image, 2, 2);
  EXPECT_EQ(corner[0], corner[1]);
  EXPECT_EQ(corner[1], corner[2]);
  EXPECT_GT(corner[0], 40);
  EXPECT_LT(corner[0], 240);
}

TEST_P(SunView, TurnedAwayThereIsNoYellow) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  Renderer renderer = renderer_of(scene);
  Image const image = renderer.sun_view(sun_at(0, 30), 0, 100);
  EXPECT_EQ(count(image, yellow), 0);
  EXPECT_GT(count(image, blue), 1000);
}

TEST_P(SunView, SizeOutOfRangeIsAnErrorThatSaysWhich) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  Renderer renderer = renderer_of(scene);
  for (int const size : {0, -5, 1 << 20}) {
    try {
      renderer.sun_view(sun_at(180, 30), 0, size);
      ADD_FAILURE() << size;
    } catch (Error const& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(size)), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace gpu_shading
