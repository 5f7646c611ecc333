// CPU time of a sun direction for one scene with sheets that are opaque, transparent, or perforated
// by a pattern or an image, and the mean sunlit area, by which two builds can be compared.
//
//   screen_cost [sheets]    of one kind, by its name

#include <array>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/processor_time.h"
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

void print_row(std::string_view name, Finish const& finish, int across, int along, int resolution) {
  Renderer renderer = renderer_of(roof(across, along, finish), resolution);
  std::array<SurfaceId, receivers> asked{};
  for (SurfaceId id = 0; id < receivers; ++id) asked[id] = id;
  renderer.projected_sunlit_areas(sun_at(180, 45), asked);  // creates targets and counts receivers
  constexpr int directions = 10;
  double area = 0.0;
  double const start = processor_seconds();
  for (int i = 0; i < directions; ++i) {
    for (Sunlit const& sunlit :
         renderer.projected_sunlit_areas(sun_at(100 + 16 * i, 25 + 4 * i), asked)) {
      area += sunlit.projected_area;
    }
  }
  double const seconds = processor_seconds() - start;
  std::printf("%-22.*s %6d %8d %8.2f ms  %.13f\n", static_cast<int>(name.size()), name.data(),
              across * along, resolution, 1e3 * seconds / directions,
              area / directions / receivers);
  std::fflush(stdout);
}

// Holes of 6 to 30 mm at random positions, half open on average, like the gradient of the academic
// building.
OpacityTile random_holes() {
  constexpr double width = 0.584;
  constexpr double height = 4.45;
  constexpr double texel = 2e-3;
  constexpr int columns = 292;
  constexpr int rows = 2225;
  std::vector<float> opacity(std::size_t{columns} * rows, 1.0F);
  std::mt19937 engine(1);
  auto const random = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  for (int hole = 0; hole < 6500; ++hole) {
    double const half = random(0.003, 0.015);
    double const u = random(half, width - half);
    double const v = random(half, height - half);
    for (int row = static_cast<int>((v - half) / texel); row * texel < v + half; ++row) {
      for (int column = static_cast<int>((u - half) / texel); column * texel < u + half; ++column) {
        double const across = (column + 0.5) * texel - u;
        double const up = (row + 0.5) * texel - v;
        if (across * across + up * up > half * half) continue;
        opacity[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] = 0.0F;
      }
    }
  }
  return OpacityTile(width, height, columns, rows, opacity);
}

void print_table(std::string_view only) {
  auto const glass = std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
  HolePattern const holes(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = 0.1, .pitch = 0.135});
  HolePattern const small({.hole = Hole::Round,
                           .arrangement = Arrangement::Staggered60,
                           .size = 0.00635,
                           .pitch = 0.00855});
  auto const screened = [](auto const& of, ScreenDetail detail, double thickness) -> Finish {
    auto const screen = std::make_shared<PerforatedScreen const>(
        of, Sheet{.thickness = thickness, .detail = detail});
    screen->transmittance();  // its construction is not timed
    return [screen](Surface& sheet) { sheet.filter.set(PerforatedSheet{screen}); };
  };
  OpacityTile const image(holes, 0.1 / 48);
  OpacityTile const fractional(holes, 0.1 / 48, std::nullopt);
  OpacityTile const random = random_holes();
  struct Kind {
    std::string_view name;
    Finish finish;
  };
  std::array const kinds{
      Kind{"opaque", [](Surface&) {}},
      Kind{"transparent", [&](Surface& sheet) { sheet.filter.set(AngularTransmittance{glass}); }},
      Kind{"pattern, holes", screened(holes, ScreenDetail::holes, 0.05)},
      Kind{"pattern, effective", screened(holes, ScreenDetail::effective, 0.05)},
      Kind{"pattern, small holes", screened(small, ScreenDetail::automatic, 0.003)},
      Kind{"image, holes", screened(image, ScreenDetail::holes, 0.05)},
      Kind{"image, effective", screened(image, ScreenDetail::effective, 0.05)},
      Kind{"image, fractional", screened(fractional, ScreenDetail::holes, 0.05)},
      Kind{"random, holes", screened(random, ScreenDetail::holes, 0.003)},
      Kind{"random, effective", screened(random, ScreenDetail::effective, 0.003)},
  };
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf("sheets                 number   pixels a direction     sunlit, m2\n");
  for (int const resolution : {256, 512, 1024}) {
    for (auto const [across, along] : {std::array{1, 1}, std::array{5, 2}, std::array{10, 10}}) {
      for (Kind const& kind : kinds) {
        if (!only.empty() && kind.name != only) continue;
        print_row(kind.name, kind.finish, across, along, resolution);
      }
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main(int argc, char** argv) {
  return gpu_shading::print_or_say_why("screen_cost",
                                       [&] { gpu_shading::print_table(argc > 1 ? argv[1] : ""); });
}
