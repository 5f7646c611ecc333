#include "backends/opengl/raster/crowd_masks.h"

#include <gtest/gtest.h>

#include <vector>

#include "antialias/antialias.h"
#include "backends/cpu/coverage.h"
#include "backends/opengl/egl/device.h"
#include "geometry/triangulation.h"
#include "support/crowds.h"
#include "support/gl_renderer.h"
#include "support/lit_on_cpu.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

// Against the CPU, which has the same samples.
void expect_as_on_cpu(Scene const& scene, char const* name, int directions) {
  SCOPED_TRACE(name);
  auto const device = egl::open(by_opengl);
  ASSERT_TRUE(device);
  egl::Current const current = device->context.make_current();
  Casters const casters(scene);
  std::vector<Mesh> const meshes = triangulate_all(scene);
  Coverage const coverage(meshes);
  ASSERT_TRUE(CrowdMasks::fit(meshes));
  CrowdMasks masks(scene, meshes, casters, !device->info.software);
  PlaneFrame const frame = *plane_frame(scene[0].polygon);
  std::vector<double> expected;
  std::vector<Tile> tiles;
  for (int const side : {16, 32}) {
    tiles.push_back(make_tile(scene[0].polygon, frame, side, 4096));
  }
  int partly_lit = 0;
  for (int i = 0; i < directions; ++i) {
    glm::dvec3 const towards_sun =
        to_vector(sun_at(100 + 160.0 * i / directions, 4 + 75.0 * i / directions));
    if (glm::dot(frame.normal, towards_sun) <= 0.0) continue;
    std::vector<SurfaceId> const listed = casters.in_view(scene, 0, frame, towards_sun).casters;
    for (Tile const& tile : tiles) {
      View const view = view_in_front(frame, tile.map, towards_sun);
      CastersInView in_view{listed, {}, {}};
      TileGrid const grid = sample_grid(tile, view, repeats_among(scene, listed));
      expected.push_back(lit_on_cpu(coverage, tile, grid, view, in_view, 1));
      double const share = expected.back() / static_cast<double>(tile.counted_pixels);
      partly_lit += share > 0.02 && share < 0.98 ? 1 : 0;
      ReceiverView question;
      question.frame = &frame;
      question.tile = &tile;
      question.towards_sun = towards_sun;
      question.casters = listed;
      question.crowd = &casters;
      EXPECT_EQ(masks.add(question), expected.size() - 1);
    }
  }
  masks.finish();
  EXPECT_GT(partly_lit, directions);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    Tile const& tile = tiles[i % tiles.size()];
    auto const [own, lit] = masks.samples(i);
    auto const pixels = static_cast<double>(tile.counted_pixels);
    EXPECT_NEAR(lit * pixels / own, expected[i], 1e-4 * pixels) << i;
  }
}

TEST(CrowdMasks, CoverTheSamplesThatTheCpuCovers) {
  expect_as_on_cpu(triangle_soup(400, 3), "triangles", 30);
  Scene scene = mixed_crowd(700);
  expect_as_on_cpu(scene, "mixed", 30);
  scene.set_rule(thirds(scene));
  expect_as_on_cpu(scene, "with a rule", 30);
  // More views than a submission takes.
  expect_as_on_cpu(mixed_crowd(100), "many views", 150);
}

// As a renderer asks: the window behind a crowd, and one of its casters.
TEST(CrowdMasks, AreTakenByARenderer) {
  Scene const scene = mixed_crowd(1500);
  GlSettings settings;
  settings.crowds = true;
  Renderer device = gl_renderer(scene, 256, settings);
  Renderer cpu = renderer_of(scene, 256, on_cpu);
  std::vector<SurfaceId> const window{0};
  for (int i = 0; i < 5; ++i) {
    SunDirection const sun = sun_at(120 + 25 * i, 10 + 12 * i);
    EXPECT_NEAR(device.projected_sunlit_areas(sun, window)[0].projected_area,
                cpu.projected_sunlit_areas(sun, window)[0].projected_area, 6 * 1e-3);
  }
}

}  // namespace
}  // namespace gpu_shading
