// Cost of a sun direction for 100 receivers behind 1,000 trees, ellipsoids and meshes of as many
// triangles as in the example, beside as many boxes of five sides, on the CPU and drawn by OpenGL.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <vector>

#include "support/crown_meshes.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int directions = 20;
constexpr int receivers = 100;
constexpr int trees = 1000;

Scene street(std::optional<Crown> crown) {
  Scene scene;
  for (int i = 0; i < receivers; ++i) {
    auto const place = std::div(i, 20);
    scene.add({"window", south_facing(4.0 * place.rem, 0.0, 1.0 + 3.0 * place.quot, 2.5, 1.5)});
  }
  for (int i = 0; i < trees; ++i) {
    auto const place = std::div(i, 50);
    glm::dvec3 const corner(-60.0 + 4.0 * place.rem, -4.0 - 5.0 * place.quot, 2.0);
    constexpr double side = 3.5;
    constexpr double height = 6.0;
    Surface plan{"tree", level(corner.x, corner.y, corner.z, side, side)};
    if (crown) {
      crown->height = height;
      plan.filter.set(*crown);
      scene.add(plan);
      continue;
    }
    for (Polygon const& face :
         {level(corner.x, corner.y, corner.z + height, side, side),
          parallelogram(corner, {side, 0, 0}, {0, 0, height}),
          parallelogram(corner + glm::dvec3(0, side, 0), {side, 0, 0}, {0, 0, height}),
          parallelogram(corner, {0, side, 0}, {0, 0, height}),
          parallelogram(corner + glm::dvec3(side, 0, 0), {0, side, 0}, {0, 0, height})}) {
      scene.add({"box", face});
    }
  }
  return scene;
}

double milliseconds(Scene const& scene, DeviceChoice device) {
  RendererOptions options;
  options.device = device;
  Renderer renderer(scene, options);
  std::vector<SurfaceId> ids(receivers);
  std::iota(ids.begin(), ids.end(), SurfaceId{0});
  std::vector<SunDirection> suns;
  suns.reserve(directions);
  for (int i = 0; i < directions; ++i) suns.push_back(sun_at(110 + 7 * i, 15 + 2 * i));
  renderer.projected_sunlit_areas(suns, ids);  // creates tiles
  double const before = renderer.statistics().seconds;
  renderer.projected_sunlit_areas(suns, ids);
  return 1e3 * (renderer.statistics().seconds - before) / directions;
}

void print_table() {
  std::printf("%d receivers behind %d trees, ms a direction\n", receivers, trees);
  std::printf("%-8s %8s %8s\n", "", "CPU", "OpenGL");
  struct Row {
    char const* name;
    Scene scene;
  };
  constexpr int sides = 12;
  Crown const mesh{.shape = CrownShape::mesh, .leaf_density = 1.2, .mesh = ball_mesh(sides)};
  for (Row const& row : {Row{"crowns", street(Crown{.leaf_density = 1.2})},
                         Row{"meshes", street(mesh)}, Row{"boxes", street(std::nullopt)}}) {
    std::printf("%-8s %8.1f", row.name, milliseconds(row.scene, on_cpu));
    std::fflush(stdout);
    std::printf(" %8.1f\n", milliseconds(row.scene, {numbered_device(0), false}));
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("crown_cost", gpu_shading::print_table); }
