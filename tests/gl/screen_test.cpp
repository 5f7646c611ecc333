#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "gpu_shading/perforated_screen.h"
#include "shapes.h"

// Perforated sheets as the renderer draws them, against what is known of them in closed form.
namespace gpu_shading {
namespace {

constexpr double mm = 1e-3;

HolePattern round_holes(double size, double pitch) {
  return HolePattern(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = size, .pitch = pitch});
}

// A level receiver of 7 x 12 tiles below a sheet that covers the sun's way to all of it. The
// sheet's second edge, along which is u, runs north.
Scene covered(HolePattern const& holes, std::shared_ptr<PerforatedScreen const> screen) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 7 * holes.height(), 12 * holes.width())});
  Surface sheet{"screen", level(-2, -2, 0.1, 5, 5)};
  sheet.screen = std::move(screen);
  scene.add(sheet);
  return scene;
}

TEST(Screen, OfHolesLetsTheClosedFormThrough) {
  HolePattern const holes = round_holes(50 * mm, 80 * mm);
  for (auto const detail : {ScreenDetail::holes, ScreenDetail::effective}) {
    Sheet sheet{.thickness = 30 * mm};
    sheet.detail = detail;
    Renderer renderer =
        renderer_of(covered(holes, std::make_shared<PerforatedScreen const>(holes, sheet)), 1024);
    for (double const altitude : {90.0, 75.0, 60.0, 45.0, 35.0}) {
      SunDirection const sun = sun_at(33.0, altitude);
      glm::dvec3 const s = to_vector(sun);
      double const slope = 30 * mm / s.z;
      double const exact = holes.transmittance(slope * s.y, -slope * s.x);
      double const got =
          sunlit(renderer, sun, 0).projected_area / (s.z * area(renderer.scene()[0].polygon));
      EXPECT_NEAR(got, exact, detail == ScreenDetail::holes ? 2e-4 : 1e-6)
          << static_cast<int>(detail) << " altitude " << altitude;
    }
  }
}

}  // namespace
}  // namespace gpu_shading
