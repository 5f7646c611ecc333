#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "backends/cpu/cpu_picture_raster.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene_view.h"
#include "gpu_shading/transmittance.h"
#include "scene/casters.h"
#include "support/exact.h"
#include "support/random_scene.h"
#include "support/shapes.h"

// What pictures are made of on the CPU, against rays that are followed one by one and closed forms.
namespace gpu_shading {
namespace {

// A scene with what it needs to be rasterised.
struct Pictured {
  Scene scene;
  Transmission transmission;
  CpuPictureRaster raster;

  explicit Pictured(Scene of)
      : scene(std::move(of)),
        transmission(scene),
        raster({scene, triangulate_all(scene), transmission}) {}
};

// Looking down from z = 10, of 0 to `width` in x and 0 to `height` in y.
PictureGrid from_above(double width, double height, int columns, int rows) {
  PictureGrid grid;
  grid.view.x = {2.0 / width, 0.0, 0.0, -1.0};
  grid.view.y = {0.0, 2.0 / height, 0.0, -1.0};
  grid.view.z = {0.0, 0.0, -0.05, 0.5};
  grid.width = columns;
  grid.height = rows;
  return grid;
}

constexpr glm::dvec3 up{0.0, 0.0, 1.0};

template <typename T>
T value_at(std::vector<T> const& values, PictureGrid const& grid, int column, int row) {
  return values.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                   static_cast<std::size_t>(column));
}

TEST(CpuPictureRaster, TwoPlanesThatCrossHideEachOtherFromTheLineOn) {
  Pictured pictured([] {
    Scene scene;
    scene.add({"level", level(0, 0, 0, 4, 2)});
    scene.add({"tilted", parallelogram({0, 0, -1}, {4, 0, 2}, {0, 2, 0})});
    return scene;
  }());
  PictureGrid const grid = from_above(4.0, 2.0, 200, 100);
  std::vector<SurfaceId> const both{0, 1};
  auto const seen = pictured.raster.nearest(grid, both);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      ASSERT_EQ(value_at(seen, grid, column, row), column < 100 ? 1U : 2U) << column << ' ' << row;
    }
  }
}

TEST(CpuPictureRaster, OfSurfacesInOnePlaneTheFirstIsSeen) {
  Pictured pictured([] {
    Scene scene;
    scene.add({"wall", parallelogram({0.1, 0.2, 0.3}, {3, 0, 0.7}, {0, 3, 0.9})});
    scene.add(
        {"the same", parallelogram({0.4, 0.5, 0.3 + 0.07 + 0.09}, {1, 0, 0.7 / 3}, {0, 1, 0.3})});
    return scene;
  }());
  PictureGrid const grid = from_above(4.0, 4.0, 123, 123);
  for (std::vector<SurfaceId> const& order : {std::vector<SurfaceId>{0, 1}, {1, 0}}) {
    auto const seen = pictured.raster.nearest(grid, order);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 2U) > 0, order.front() == 1);
  }
}

// By the even-odd rule in the picture, and the polygon's own plane.
std::optional<double> depth_at(Polygon const& polygon, PictureGrid const& grid, int column,
                               int row) {
  View const& view = grid.view;
  glm::dvec2 const place(2.0 * (column + 0.5) / grid.width - 1.0,
                         2.0 * (row + 0.5) / grid.height - 1.0);
  bool inside = false;
  auto const cross_ring = [&](Ring const& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      glm::dvec3 const p = ring[i] - view.origin;
      glm::dvec3 const q = ring[(i + 1) % ring.size()] - view.origin;
      glm::dvec2 const a(at(view.x, p), at(view.y, p));
      glm::dvec2 const b(at(view.x, q), at(view.y, q));
      if ((a.y > place.y) == (b.y > place.y)) continue;
      if (place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  };
  cross_ring(polygon.outline);
  for (Ring const& hole : polygon.holes) cross_ring(hole);
  if (!inside) return std::nullopt;
  // A point that is seen there, moved along the ray onto the plane.
  glm::dvec3 const x(view.x);
  glm::dvec3 const y(view.y);
  glm::dvec3 const ray(view.z);
  glm::dvec3 const start = view.origin + x * ((place.x - view.x.w) / glm::dot(x, x)) +
                           y * ((place.y - view.y.w) / glm::dot(y, y));
  glm::dvec3 const n = normal(polygon);
  double const way = glm::dot(n, polygon.outline.front() - start) / glm::dot(n, ray);
  return at(view.z, start + way * ray - view.origin);
}

TEST(CpuPictureRaster, SeesWhatRaysMeetFirst) {
  std::size_t unlike = 0;
  std::size_t seen_surfaces = 0;
  std::size_t all = 0;
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    RandomScene const random = random_scene(seed);
    Pictured pictured(random.scene);
    glm::dvec3 const towards_sun = to_vector(random.sun);
    glm::dvec3 const right = glm::normalize(glm::cross(towards_sun, {0.3, 0.5, -0.2}));
    glm::dvec3 const above = glm::cross(towards_sun, right);
    PictureGrid grid;
    grid.view.origin = random.scene[0].polygon.outline.front();
    grid.view.x = glm::dvec4(right / 3.0, 0.1);
    grid.view.y = glm::dvec4(above / 2.0, -0.2);
    grid.view.z = glm::dvec4(-towards_sun / 100.0, 0.5);
    grid.width = 120;
    grid.height = 80;
    std::vector<SurfaceId> all_ids;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) all_ids.push_back(id);
    auto const seen = pictured.raster.nearest(grid, all_ids);
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        std::uint32_t expected = 0;
        double nearest = 2.0;
        for (SurfaceId const id : all_ids) {
          auto const depth = depth_at(random.scene[id].polygon, grid, column, row);
          if (!depth || *depth >= nearest) continue;
          nearest = *depth;
          expected = id + 1;
        }
        ++all;
        seen_surfaces += expected > 0 ? 1 : 0;
        unlike += value_at(seen, grid, column, row) != expected ? 1 : 0;
      }
    }
  }
  std::printf("%zu of %zu pixels are not what a ray meets\n", unlike, all);
  EXPECT_GT(seen_surfaces, all / 6);
  // Edges are found in single precision.
  EXPECT_LE(unlike, 2U);
}

TEST(CpuPictureRaster, LuminanceIsTheSunlitFraction) {
  double worst = 0.0;
  int shaded = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    RandomScene const random = random_scene(seed);
    Pictured pictured(random.scene);
    ShadedReceiver receiver{0, to_vector(random.sun), {}, {}};
    PlaneFrame const frame = *plane_frame(random.scene[0].polygon);
    receiver.casters =
        Casters(random.scene).in_view(random.scene, 0, frame, receiver.towards_sun).casters;
    // Its bounding square, somewhat turned.
    double const size = 0.8 * (frame.width + frame.height);
    PictureGrid grid;
    grid.view = view_in_front(frame, fit_tile(frame, random.scene[0].polygon.outline, 700),
                              receiver.towards_sun);
    grid.view.z = glm::dvec4(-receiver.towards_sun / (100.0 * size), 0.5);
    grid.width = 700;
    grid.height = 700;
    PictureGrid whole = grid;
    whole.view.cut = View().cut;
    auto const own = pictured.raster.nearest(whole, {&receiver.receiver, 1});
    auto const luminance = pictured.raster.luminance(grid, receiver);
    double lit = 0.0;
    double pixels = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i] == 0) continue;
      pixels += 1.0;
      lit += static_cast<double>(luminance[i]);
      ASSERT_TRUE(luminance[i] == 0.0F || luminance[i] == 1.0F);
    }
    double const exact = exact::projected_sunlit_area(random.scene, random.sun, 0) /
                         exact::projected_area(random.scene, random.sun, 0);
    worst = std::max(worst, std::abs(lit / pixels - exact));
    shaded += exact < 0.95 ? 1 : 0;
    // On the same lattice of pixels the share is the renderer's answer.
    Renderer renderer = renderer_of(random.scene, 700, on_cpu);
    double const answer = sunlit(renderer, random.sun, 0).projected_area /
                          exact::projected_area(random.scene, random.sun, 0);
    EXPECT_NEAR(lit / pixels, answer, 1e-3) << seed;
  }
  std::printf("lit pixels are off the sunlit fraction by %.1e at most\n", worst);
  EXPECT_GT(shaded, 12);
  EXPECT_LT(worst, 5e-4);
}

// Square holes of half the pitch: an open fraction of a quarter.
std::shared_ptr<PerforatedScreen const> quarter_open() {
  HolePattern const holes(
      {.hole = Hole::Square, .arrangement = Arrangement::Straight, .size = 0.1, .pitch = 0.2});
  return std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.001});
}

TEST(CpuPictureRaster, ScreensBehindASurfaceDimNothing) {
  Pictured pictured([] {
    Scene scene;
    scene.add({"ground", level(0, 0, 0, 4, 4)});
    scene.add({"roof", level(0, 0, 2, 4, 2)});
    Surface screen{"screen", level(0, 0, 1, 2, 4)};
    screen.filter.set(PerforatedSheet{quarter_open()});
    scene.add(std::move(screen));
    return scene;
  }());
  PictureGrid const grid = from_above(4.0, 4.0, 400, 400);
  std::vector<SurfaceId> const plain{0, 1};
  auto const passed = pictured.raster.through_bodies(grid, up, plain);
  double sum = 0.0;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      float const here = value_at(passed, grid, column, row);
      if (row < 200 || column >= 200) {
        ASSERT_EQ(here, 1.0F) << column << ' ' << row;
      } else {
        sum += static_cast<double>(here);
      }
    }
  }
  EXPECT_NEAR(sum / (200.0 * 200.0), 0.25, 1e-3);
}

TEST(CpuPictureRaster, ShadesMultiply) {
  Pictured pictured([] {
    Scene scene;
    scene.add({"terrace", level(0, 0, 0, 4, 4)});
    scene.add({"glass", level(0, 0, 1, 2, 4)});
    scene.add({"wood", level(0, 0, 2, 4, 1)});
    Surface screen{"screen", level(0, 2, 3, 4, 2)};
    screen.filter.set(PerforatedSheet{quarter_open()});
    scene.add(std::move(screen));
    return scene;
  }());
  PictureGrid grid = from_above(4.0, 4.0, 400, 400);
  grid.view.cut = glm::dvec4(up, -clearance);
  ShadedReceiver const shaded{
      0, up, {1, 2, 3}, {{0.5F, Shade::unscheduled}, {}, {1.0F, Shade::unscheduled}}};
  auto const luminance = pictured.raster.luminance(grid, shaded);
  auto const mean = [&](int first_column, int first_row) {
    double sum = 0.0;
    for (int row = first_row; row < first_row + 100; ++row) {
      for (int column = first_column; column < first_column + 100; ++column) {
        sum += static_cast<double>(value_at(luminance, grid, column, row));
      }
    }
    return sum / 1e4;
  };
  EXPECT_EQ(mean(0, 0), 0.0);
  EXPECT_EQ(mean(300, 0), 0.0);
  EXPECT_EQ(mean(0, 100), 0.5);
  EXPECT_EQ(mean(300, 100), 1.0);
  EXPECT_NEAR(mean(0, 200), 0.125, 1e-3);
  EXPECT_NEAR(mean(300, 200), 0.25, 1e-3);
}

TEST(CpuPictures, NeedNoOpenGl) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 3)});
  scene.add({"overhang", level(-1, -0.5, 3, 5, 0.5)});
  Renderer renderer = renderer_of(scene, 64, on_cpu);
  EXPECT_EQ(renderer.sun_view(sun_at(180, 30), 0, 100).width, 100);
  std::vector<SurfaceId> const shown{0, 1};
  std::vector<std::optional<double>> const fractions{0.5, std::nullopt};
  SceneView view(scene, shown, on_cpu);
  EXPECT_FALSE(view.draw(sun_at(180, 30), fractions, 100).pixels.empty());
  EXPECT_EQ(dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD), nullptr) << "libEGL was loaded";
}

}  // namespace
}  // namespace gpu_shading
