// CPU time of a view as its answer is chosen, without samples where that is expected to cost less,
// and by samples alone; and the largest difference of the sunlit fractions.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "gpu_shading/device.h"
#include "support/processor_time.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int directions = 40;
constexpr double window_area = 6.0;

// A window of 3 x 2 m and its room.
Scene window(bool room) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  if (room) {
    scene.add({"floor", parallelogram({-1, 0, -0.5}, {5, 0, 0}, {0, 5, 0}), Casting::never});
    scene.add({"ceiling", parallelogram({-1, 0, 2.5}, {0, 5, 0}, {5, 0, 0}), Casting::never});
    scene.add({"north", south_facing(-1, 5, -0.5, 5, 3), Casting::never});
    scene.add({"west", parallelogram({-1, 0, -0.5}, {0, 5, 0}, {0, 0, 3}), Casting::never});
    scene.add({"east", parallelogram({4, 0, -0.5}, {0, 0, 3}, {0, 5, 0}), Casting::never});
  }
  return scene;
}

void add_louvres(Scene& scene, int count, int schedule) {
  double const depth = 1.0 / count;
  for (int i = 0; i < count; ++i) {
    double const height = 2.0 * (i + 0.5) / count;
    Surface louvre{"louvre",
                   parallelogram({-0.5, -0.1 - depth, height}, {4, 0, 0}, {0, depth, 0.4 * depth})};
    louvre.filter.schedule = schedule;
    scene.add(louvre);
  }
}

// Quadrilaterals of half of the window's area in all, in any direction.
void add_leaves(Scene& scene, int count, int schedule) {
  std::mt19937 engine(1);
  auto const random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  double const side = std::sqrt(9.0 / count);
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const corner(random(-0.5, 3.0), random(-2.0, -0.2), random(-0.5, 4.0));
    double const turn = random(0.0, 3.14);
    Surface leaf{"leaf", parallelogram(corner, side * glm::dvec3(std::cos(turn), 0, std::sin(turn)),
                                       side * glm::dvec3(-std::sin(turn), 0, std::cos(turn)))};
    leaf.filter.schedule = schedule;
    scene.add(leaf);
  }
}

struct Cost {
  double microseconds = 0.0;
  std::vector<double> areas;
};

Cost cost(Scene const& scene, bool room, bool samples, double error) {
  RendererOptions options;
  options.device = on_cpu;
  options.samples_only = samples;
  options.error = error;
  Renderer renderer(scene, options);
  Cost cost;
  std::vector<SurfaceId> const interiors{1, 2, 3, 4, 5};
  constexpr int times = 5;
  double before = 0.0;
  for (int time = 0; time <= times; ++time) {
    if (time == 1) before = processor_seconds();  // all tiles have been made
    cost.areas.clear();
    for (int i = 0; i < directions; ++i) {
      SunDirection const sun = sun_at(100 + 4 * i, 5 + 1.5 * i);
      if (room) {
        for (Sunlit const& part : renderer.interior_sunlit_areas(sun, 0, interiors)) {
          double area = part.projected_area;
          for (auto const& scheduled : part.scheduled) area += 0.5 * scheduled.projected_area;
          cost.areas.push_back(area);
        }
      } else {
        cost.areas.push_back(sunlit(renderer, sun, 0).projected_area);
      }
    }
  }
  cost.microseconds = 1e6 * (processor_seconds() - before) / (times * directions);
  return cost;
}

void print_row(char const* kind, int count, bool room, int schedule) {
  Scene scene = window(room);
  (kind == std::string("louvres") ? add_louvres : add_leaves)(scene, count, schedule);
  Cost const chosen = cost(scene, room, false, 1e-3);
  Cost const samples = cost(scene, room, true, 1e-3);
  Cost const rough = cost(scene, room, false, 1e-2);
  Cost const rough_samples = cost(scene, room, true, 1e-2);
  double most = 0.0;
  for (std::size_t i = 0; i < chosen.areas.size(); ++i) {
    most = std::max(most, std::abs(chosen.areas[i] - samples.areas[i]) / window_area);
  }
  std::printf("%5d %-8s %-6s %-10s %8.1f %8.1f %10.1f %8.1f   %.1e\n", count, kind,
              room ? "room" : "alone", schedule < 0 ? "opaque" : "scheduled", chosen.microseconds,
              samples.microseconds, rough.microseconds, rough_samples.microseconds, most);
}

void print_table() {
  limit_threads(1);
  std::printf("CPU, one thread, microseconds a view\n");
  std::printf(
      "casters        window shades      chosen  samples   (at 1e-2  samples)  difference\n");
  for (bool const room : {false, true}) {
    for (int const schedule : {-1, 0}) {
      for (char const* const kind : {"louvres", "leaves"}) {
        for (int const count : {1, 5, 20, 50, 200, 1000}) print_row(kind, count, room, schedule);
      }
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("exact_cost", gpu_shading::print_table); }
