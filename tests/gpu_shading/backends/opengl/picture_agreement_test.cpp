// The same pictures rasterised on the CPU and by OpenGL: they may differ where the edge of a
// surface or a shadow meets the centre of a pixel, and nowhere else.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene_view.h"
#include "gpu_shading/transmittance.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr std::uint32_t scenes = 60;

struct Pixels {
  std::size_t all = 0;
  std::size_t unlike = 0;

  double share() const { return static_cast<double>(unlike) / static_cast<double>(all); }
};

// Those in which some channel differs by more than `most`, of 255.
Pixels compare(Image const& a, Image const& b, int most) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  Pixels pixels;
  for (std::size_t i = 0; i + 2 < std::min(a.pixels.size(), b.pixels.size()); i += 3) {
    bool unlike = false;
    for (std::size_t k = i; k < i + 3; ++k) unlike |= std::abs(a.pixels[k] - b.pixels[k]) > most;
    ++pixels.all;
    pixels.unlike += unlike ? 1 : 0;
  }
  return pixels;
}

enum class Casters { opaque, glass, perforated };

Scene scene_of(RandomScene const& random, Casters casters) {
  static auto const glass = std::make_shared<Transmittance const>(Transmittance::constant(0.6));
  static auto const sheet = [] {
    HolePattern const holes(
        {.hole = Hole::Square, .arrangement = Arrangement::Straight, .size = 0.1, .pitch = 0.2});
    return std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.01});
  }();
  Scene scene;
  for (SurfaceId id = 0; id < random.scene.size(); ++id) {
    Surface surface = random.scene[id];
    if (id % 2 == 1 && casters == Casters::glass) surface.filter.set(AngularTransmittance{glass});
    // Screens have no holes of their own.
    if (id % 2 == 1 && casters == Casters::perforated && surface.polygon.holes.empty()) {
      surface.filter.set(PerforatedSheet{sheet});
    }
    scene.add(std::move(surface));
  }
  return scene;
}

// OpenGL multiplies in 8 bits, which rounds at each caster.
constexpr int few_greys = 3;

double unlike_sun_views(Casters casters, int size, std::uint32_t step = 1) {
  Pixels sum;
  for (std::uint32_t seed = 1; seed <= scenes; seed += step) {
    RandomScene const random = random_scene(seed);
    Scene const scene = scene_of(random, casters);
    Renderer drawing = renderer_of(scene, 64, by_opengl);
    Renderer counting = renderer_of(scene, 64, on_cpu);
    Pixels const pixels = compare(drawing.sun_view(random.sun, 0, size),
                                  counting.sun_view(random.sun, 0, size), few_greys);
    sum.all += pixels.all;
    sum.unlike += pixels.unlike;
  }
  std::printf("sun's views of %d pixels: %zu of %zu pixels differ, %.1e\n", size, sum.unlike,
              sum.all, sum.share());
  return sum.share();
}

TEST(PictureAgreement, SunViewsOfOpaqueCasters) {
  EXPECT_LT(unlike_sun_views(Casters::opaque, 400), 3e-5);
}

TEST(PictureAgreement, SunViewsThroughGlass) {
  EXPECT_LT(unlike_sun_views(Casters::glass, 400), 3e-5);
}

TEST(PictureAgreement, SunViewsThroughScreens) {
  // A pixel is a mean of 400 samples, so that a sample that differs shows in many pixels.
  EXPECT_LT(unlike_sun_views(Casters::perforated, 200, 6), 1e-3);
}

TEST(PictureAgreement, WholeScenes) {
  Pixels sum;
  for (Casters const casters : {Casters::opaque, Casters::glass, Casters::perforated}) {
    for (std::uint32_t seed = 1; seed <= scenes; seed += 3) {
      RandomScene const random = random_scene(seed);
      Scene const scene = scene_of(random, casters);
      std::vector<SurfaceId> shown;
      for (SurfaceId id = 0; id < scene.size(); ++id) shown.push_back(id);
      std::vector<std::optional<double>> fractions(scene.size());
      fractions[0] = 0.3;
      Pixels const pixels =
          compare(SceneView(scene, shown, by_opengl).draw(random.sun, fractions, 400),
                  SceneView(scene, shown, on_cpu).draw(random.sun, fractions, 400), few_greys);
      sum.all += pixels.all;
      sum.unlike += pixels.unlike;
    }
  }
  std::printf("whole scenes: %zu of %zu pixels differ, %.1e\n", sum.unlike, sum.all, sum.share());
  EXPECT_LT(sum.share(), 1.5e-4);
}

}  // namespace
}  // namespace gpu_shading
