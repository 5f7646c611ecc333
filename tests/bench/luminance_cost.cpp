// What a direction of the sun costs: one scene with its panes opaque, transparent (by each way of
// summing) and scheduled.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "gpu_shading/transmittance.h"
#include "support/gl_renderer.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

enum class Panes { opaque, transparent, scheduled };

// 25 x 20 panes of a double-curved canopy, 24 x 19 m, over 20 receivers.
Scene canopy(Panes panes) {
  constexpr int across = 25;
  constexpr int along = 20;
  auto const glass = std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
  Scene scene;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      scene.add({"receiver", level(1 + 4.5 * column, 1 + 4.5 * row, 0, 4, 4)});
    }
  }
  auto const node = [](int i, int j) {
    double const x = 24.0 * i / across;
    double const y = 19.0 * j / along;
    return glm::dvec3(x, y, 4 + 2 * std::sin(x / 8) * std::cos(y / 6));
  };
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < across; ++i) {
      Surface pane{"pane", {{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, {}}};
      if (panes == Panes::transparent) pane.filter.set(AngularTransmittance{glass});
      if (panes == Panes::scheduled) pane.filter.schedule = (i + j) % 3;
      scene.add(pane);
    }
  }
  return scene;
}

constexpr int receivers = 20;

void print_row(char const* name, Renderer renderer, int resolution) {
  std::array<SurfaceId, receivers> asked{};
  for (SurfaceId id = 0; id < receivers; ++id) asked[id] = id;
  renderer.projected_sunlit_areas(sun_at(180, 45), asked);  // makes targets and counts receivers
  std::size_t const drawn = renderer.statistics().casters_drawn;
  constexpr int directions = 40;
  auto const start = std::chrono::steady_clock::now();
  for (int i = 0; i < directions; ++i) {
    renderer.projected_sunlit_areas(sun_at(100 + 4 * i, 25 + i), asked);
  }
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%-24s %10d %8.2f ms  (%zu casters over 20 receivers)\n", name, resolution,
              1e3 * seconds / directions,
              (renderer.statistics().casters_drawn - drawn) / directions);
  std::fflush(stdout);
}

void print_table() {
  std::printf("%s\n", renderer_of(canopy(Panes::opaque)).device().renderer.c_str());
  std::printf("500 panes                resolution  a direction\n");
  for (int const resolution : {256, 512, 1024}) {
    auto const count = [&](char const* name, Panes panes) {
      print_row(name, renderer_of(canopy(panes), resolution, on_cpu), resolution);
    };
    auto const draw = [&](char const* name, Panes panes, GlSettings const& settings) {
      print_row(name, gl_renderer(canopy(panes), resolution, settings), resolution);
    };
    count("opaque, counted", Panes::opaque);
    draw("opaque, drawn", Panes::opaque, {});
    count("transparent, counted", Panes::transparent);
    draw("transparent, compute", Panes::transparent, {.sum = LuminanceSum::compute});
    draw("transparent, readback", Panes::transparent, {.sum = LuminanceSum::readback});
    count("3 schedules, counted", Panes::scheduled);
    draw("3 schedules, drawn", Panes::scheduled, {});
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("luminance_cost", gpu_shading::print_table); }
