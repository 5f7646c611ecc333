// Cost of a ray, for a window behind louvres and for panes in any place, by their number: processor
// time of single calls, and wall-clock time of batches on all cores.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/rays.h"
#include "gpu_shading/transmittance.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr std::size_t count_of_rays = 100000;

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  glm::dvec3 direction() {
    glm::dvec3 v(0.0);
    do {
      v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (glm::dot(v, v) > 1.0 || glm::dot(v, v) < 1e-3);
    return glm::normalize(v);
  }

 private:
  std::mt19937 generator_{1};
};

// In front of a window of 3 m x 2 m, in columns of 200.
Scene louvres(int count, Surface const& like) {
  Scene scene;
  int const columns = std::max(1, count / 200);
  int const rows = count / columns;
  double const width = 3.0 / columns;
  double const pitch = 2.0 / rows;
  for (int i = 0; i < columns * rows; ++i) {
    Surface louvre = like;
    int const column = i % columns;
    int const row = i / columns;
    louvre.polygon = parallelogram({column * width, -0.3, row * pitch}, {width, 0, 0},
                                   {0, 0.8 * pitch, -0.3 * pitch});
    scene.add(std::move(louvre));
  }
  return scene;
}

// From the window to the sky.
std::vector<Ray> to_the_sky() {
  Random random;
  std::vector<Ray> rays;
  while (rays.size() < count_of_rays) {
    glm::dvec3 const direction = random.direction();
    if (direction.y > -0.05 || direction.z < 0.0) continue;
    rays.push_back({{random.between(0, 3), 0, random.between(0, 2)}, direction});
  }
  return rays;
}

glm::dvec3 in_cube(Random& random) {
  return {random.between(-10, 10), random.between(-10, 10), random.between(-10, 10)};
}

// As large together as a side of the cube.
Scene panes(int count, Surface const& like) {
  Random random;
  Scene scene;
  double const side = std::sqrt(400.0 / count);
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const a = random.direction();
    glm::dvec3 const b = glm::normalize(glm::cross(a, random.direction()));
    Surface pane = like;
    pane.polygon = parallelogram(in_cube(random), side * a, side * b);
    scene.add(std::move(pane));
  }
  return scene;
}

std::vector<Ray> anywhere() {
  Random random;
  std::vector<Ray> rays;
  rays.reserve(count_of_rays);
  for (std::size_t i = 0; i < count_of_rays; ++i) {
    rays.push_back({in_cube(random), random.direction()});
  }
  return rays;
}

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double wall_time() {
  auto const now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// The best of several, in ns per ray.
template <typename Work>
double cost(double (*now)(), Work const& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    double const start = now();
    work();
    best = std::min(best, now() - start);
  }
  return 1e9 * best / static_cast<double>(count_of_rays);
}

void print_row(std::string const& name, int count, Scene const& scene,
               std::vector<Ray> const& rays) {
  RayScene const seen(scene);
  std::vector<double> results(rays.size());
  double const single = cost(processor_time, [&] {
    std::transform(rays.begin(), rays.end(), results.begin(),
                   [&](Ray const& ray) { return seen.transmittance(ray); });
  });
  std::ptrdiff_t hits = 0;
  double const nearest = cost(processor_time, [&] {
    hits = std::count_if(rays.begin(), rays.end(),
                         [&](Ray const& ray) { return seen.nearest_opaque(ray).has_value(); });
  });
  double const batch = cost(wall_time, [&] { seen.transmittances(rays, {}, results); });
  double sum = 0.0;
  for (double const result : results) sum += result;
  std::printf("%-22s %8d %8.0f ns %8.0f ns %8.0f ns    %.3f %7td\n", name.c_str(), count, single,
              nearest, batch, sum / static_cast<double>(results.size()), hits);
  std::fflush(stdout);
}

void print_table() {
  std::printf(
      "scene                    number       a ray     nearest       batch     mean    hits\n");
  Surface const opaque;
  Surface glass;
  glass.filter.set(AngularTransmittance{std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 1.1, -0.4}))});
  Surface sheet;
  sheet.filter.set(PerforatedSheet{std::make_shared<PerforatedScreen const>(
      HolePattern({.size = 6e-3, .pitch = 9e-3}), Sheet{.thickness = 1e-3})});
  std::vector<Ray> const sky = to_the_sky();
  std::vector<Ray> const all = anywhere();
  for (int const count : {1000, 8000, 32000}) {
    print_row("louvres", count, louvres(count, opaque), sky);
    print_row("louvres of glass", count, louvres(count, glass), sky);
    print_row("perforated louvres", count, louvres(count, sheet), sky);
    print_row("panes", count, panes(count, opaque), all);
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("ray_cost", gpu_shading::print_table); }
