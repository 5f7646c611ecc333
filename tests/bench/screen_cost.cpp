// Cost of a sun direction for one scene with sheets that are opaque, transparent, or perforated by
// a pattern or a raster.

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int receivers = 20;

// Sets the optics of a sheet's surface.
using Finish = std::function<void(Surface&)>;

// Horizontal sheets side by side, 24 x 19 m in total, over 20 receivers.
Scene roof(int across, int along, Finish const& finish) {
  Scene scene;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      scene.add({"receiver", level(1 + 4.5 * column, 1 + 4.5 * row, 0, 4, 4)});
    }
  }
  double const width = 24.0 / across;
  double const depth = 19.0 / along;
  for (int row = 0; row < along; ++row) {
    for (int column = 0; column < across; ++column) {
      Surface sheet{"sheet", level(width * column, depth * row, 4, width, depth)};
      finish(sheet);
      scene.add(sheet);
    }
  }
  return scene;
}

void print_row(char const* name, Finish const& finish, int across, int along, int resolution) {
  Renderer renderer = renderer_of(roof(across, along, finish), resolution);
  std::array<SurfaceId, receivers> asked{};
  for (SurfaceId id = 0; id < receivers; ++id) asked[id] = id;
  renderer.projected_sunlit_areas(sun_at(180, 45), asked);  // creates targets and counts receivers
  constexpr int directions = 10;
  auto const start = std::chrono::steady_clock::now();
  for (int i = 0; i < directions; ++i) {
    renderer.projected_sunlit_areas(sun_at(100 + 16 * i, 25 + 4 * i), asked);
  }
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%-20s %8d %8d %8.2f ms\n", name, across * along, resolution,
              1e3 * seconds / directions);
  std::fflush(stdout);
}

void print_table() {
  auto const glass = std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
  HolePattern const holes(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = 0.1, .pitch = 0.135});
  auto const screened = [](auto const& of, ScreenDetail detail) -> Finish {
    auto const screen =
        std::make_shared<PerforatedScreen const>(of, Sheet{.thickness = 0.05, .detail = detail});
    screen->transmittance();  // its construction is not timed
    return [screen](Surface& sheet) { sheet.filter.set(PerforatedSheet{screen}); };
  };
  struct Kind {
    char const* name;
    Finish finish;
  };
  std::array const kinds{
      Kind{"opaque", [](Surface&) {}},
      Kind{"transparent", [&](Surface& sheet) { sheet.filter.set(AngularTransmittance{glass}); }},
      Kind{"pattern, holes", screened(holes, ScreenDetail::holes)},
      Kind{"pattern, effective", screened(holes, ScreenDetail::effective)},
      Kind{"raster, holes", screened(OpacityTile(holes, 0.1 / 48), ScreenDetail::holes)},
      Kind{"raster, effective", screened(OpacityTile(holes, 0.1 / 48), ScreenDetail::effective)},
  };
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf("sheets               how many   pixels a direction\n");
  for (int const resolution : {256, 512, 1024}) {
    for (auto const [across, along] : {std::array{1, 1}, std::array{5, 2}, std::array{10, 10}}) {
      for (Kind const& kind : kinds) print_row(kind.name, kind.finish, across, along, resolution);
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("screen_cost", gpu_shading::print_table); }
