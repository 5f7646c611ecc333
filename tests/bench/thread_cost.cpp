// CPU time of sun directions, one at a time and many at once, on one thread and on more; also on
// more threads than there are cores. A machine's cores are all busy if CPU time does not grow.

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/transmittance.h"
#include "support/processor_time.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

// Windows in a row, each behind its share of leaves or, if there are none, under an overhang.
Scene facade(int windows, int leaves, bool transparent) {
  Scene scene;
  std::mt19937 engine(1);
  auto const random = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  for (int i = 0; i < windows; ++i) {
    scene.add({"window", south_facing(6.0 * i, 0, 0, 3, 2)});
    scene.add({"overhang", level(6.0 * i - 0.3, -0.8, 2.1, 3.6, 0.8)});
  }
  auto const glass = std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
  double const side = std::sqrt(9.0 * windows / std::max(1, leaves));
  for (int i = 0; i < leaves; ++i) {
    glm::dvec3 const at(6.0 * (i % windows) + random(-0.5, 3.5), random(-2, -0.2), random(-0.5, 4));
    Surface leaf{"leaf", parallelogram(at, {side, side * random(-0.5, 0.5), 0}, {0, 0, side})};
    if (transparent) leaf.filter.set(AngularTransmittance{glass});
    scene.add(leaf);
  }
  return scene;
}

struct Kind {
  std::string_view name;
  int windows;
  int leaves;
  bool transparent;
  int directions;  // asked for at once
};

// Milliseconds of CPU time, the least of several.
double cost(Kind const& kind) {
  Renderer renderer = renderer_of(facade(kind.windows, kind.leaves, kind.transparent), 512);
  std::vector<SurfaceId> asked;
  asked.reserve(static_cast<std::size_t>(kind.windows));
  for (int i = 0; i < kind.windows; ++i) asked.push_back(static_cast<SurfaceId>(2 * i));
  std::vector<SunDirection> suns;
  suns.reserve(static_cast<std::size_t>(kind.directions));
  for (int i = 0; i < kind.directions; ++i) {
    suns.push_back(sun_at(130.0 + 100.0 * i / kind.directions, 25 + i % 40));
  }
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 12; ++i) {
    double const start = processor_seconds();
    renderer.projected_sunlit_areas(suns, asked);
    if (i > 0) least = std::min(least, processor_seconds() - start);  // the first makes tiles
  }
  return 1e3 * least;
}

void print_table() {
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf(
      "view                 directions  1 thread, ms         2        16   2 / 1  16 / 1\n");
  for (Kind const& kind :
       {Kind{"1,000 leaves", 1, 1000, false, 1}, Kind{"3,000 leaves", 1, 3000, false, 1},
        Kind{"32,000 leaves", 1, 32000, false, 1}, Kind{"1,000 panes", 1, 1000, true, 1},
        Kind{"10,000 panes", 1, 10000, true, 1}, Kind{"1,000 leaves", 1, 1000, false, 10},
        Kind{"20 windows", 20, 0, false, 48}, Kind{"20 windows, leaves", 20, 2000, false, 48}}) {
    std::array<double, 3> found{};
    std::array const threads{1, 2, 16};
    for (std::size_t i = 0; i < threads.size(); ++i) {
      limit_threads(threads[i]);
      tbb::task_arena arena(threads[i]);
      arena.execute([&] { found[i] = cost(kind); });
    }
    std::printf("%-22.*s %8d %13.3f %9.3f %9.3f %7.2f %7.2f\n", static_cast<int>(kind.name.size()),
                kind.name.data(), kind.directions, found[0], found[1], found[2],
                found[1] / found[0], found[2] / found[0]);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("thread_cost", gpu_shading::print_table); }
