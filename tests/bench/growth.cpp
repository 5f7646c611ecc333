// Cost of a sun direction as one quantity grows: the casters in view, the casters out of view, the
// receivers or the pixels.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int resolution = 256;

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

 private:
  std::mt19937 generator_{1};
};

// Leaves inside a box, which cover the fraction `cover` of it as seen from one side.
void add_leaves(Scene& scene, Random& random, int count, glm::dvec3 const& low,
                glm::dvec3 const& high, double cover) {
  double const side = std::sqrt(cover * (high.x - low.x) * (high.z - low.z) / count);
  for (int i = 0; i < count; ++i) {
    double const x = random.between(low.x, high.x);
    double const y = random.between(low.y, high.y);
    double const z = random.between(low.z, high.z);
    double const turn = random.between(-0.5, 0.5);
    scene.add({"leaf", parallelogram({x, y, z}, {side, side * turn, 0}, {0, 0, side})});
  }
}

// A facade of windows, each under an overhang, in as many rows as columns.
Scene facade(int windows) {
  Scene scene;
  int const across = std::max(1, static_cast<int>(std::lround(std::sqrt(windows))));
  auto const column = [&](int i) { return i % across; };
  auto const row = [&](int i) { return i / across; };
  for (int i = 0; i < windows; ++i) {
    scene.add({"window", south_facing(3.0 * column(i), 0, 3.0 * row(i), 2, 2)});
  }
  for (int i = 0; i < windows; ++i) {
    double const x = 3.0 * column(i) - 0.3;
    scene.add({"overhang", level(x, -0.8, 3.0 * row(i) + 2.1, 2.6, 0.8)});
  }
  return scene;
}

Scene leaves(int in_view, int out_of_view) {
  Scene scene;
  Random random;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  add_leaves(scene, random, in_view, {-0.5, -2, -0.5}, {3.5, -0.2, 4}, 0.5);
  // A town behind the window and to its sides, represented by trees.
  add_leaves(scene, random, out_of_view / 2, {-400, 5, 0}, {400, 400, 20}, 0.5);
  add_leaves(scene, random, out_of_view - out_of_view / 2, {1000, -400, 0}, {1400, 0, 20}, 0.5);
  return scene;
}

void print_row(char const* sweep, int value, Scene scene, int receivers, int pixels) {
  Renderer renderer = renderer_of(std::move(scene), pixels);
  std::vector<SurfaceId> asked(static_cast<std::size_t>(receivers));
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = static_cast<SurfaceId>(i);
  renderer.projected_sunlit_areas(sun_at(180, 45), asked);  // creates targets and counts receivers
  std::size_t const before = renderer.statistics().casters_drawn;
  constexpr int directions = 15;
  std::vector<double> seconds;
  for (int i = 0; i < directions; ++i) {
    auto const start = std::chrono::steady_clock::now();
    renderer.projected_sunlit_areas(sun_at(140 + 5 * i, 20 + 3 * i), asked);
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%-22s %8d %12.3f ms %10zu\n", sweep, value, 1e3 * seconds[directions / 2],
              (renderer.statistics().casters_drawn - before) / directions);
  std::fflush(stdout);
}

void print_table() {
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf("sweep                     value   a direction   casters drawn\n");
  for (int count = 64; count <= 65536; count *= 4) {
    print_row("casters in view", count, leaves(count, 0), 1, resolution);
  }
  for (int count = 1000; count <= 128000; count *= 2) {
    print_row("casters out of view", count, leaves(200, count), 1, resolution);
  }
  for (int count = 16; count <= 4096; count *= 4) {
    print_row("receivers", count, facade(count), count, resolution);
  }
  for (int side = 32; side <= 2048; side *= 2) {
    print_row("pixels a side", side, facade(16), 16, side);
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("growth", gpu_shading::print_table); }
