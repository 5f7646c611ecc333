// What the sunlit fractions of all of a scene's shading surfaces cost and how far they are off.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "scene/casters.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int repeats = 3;  // of which the fastest counts

constexpr std::size_t directions = 6;

std::array<SunDirection, directions> suns() {
  return {sun_at(10, 42),  sun_at(70, 15),  sun_at(130, 33),
          sun_at(190, 60), sun_at(250, 51), sun_at(310, 24)};
}

// A box of 10 m, whose corner is given, turned by quarters so that each side once faces south.
glm::dvec3 on_side(int side, glm::dvec3 const& corner, glm::dvec3 const& local) {
  glm::dvec2 place(local.x - 5.0, local.y - 5.0);
  for (int turn = 0; turn < side; ++turn) place = {-place.y, place.x};
  return corner + glm::dvec3(place.x + 5.0, place.y + 5.0, local.z);
}

Polygon on_side(int side, glm::dvec3 const& corner, Polygon polygon) {
  for (glm::dvec3& point : polygon.outline) point = on_side(side, corner, point);
  return polygon;
}

// Louvres of 1 m x 0.2 m, 0.25 m apart, before boxes of 10 m, row by row around the four sides:
// level or tilted outwards, so that none touches another or lies on a wall. The louvres come first.
Scene louvred_boxes(int louvres) {
  constexpr int columns = 9;
  constexpr int rows = 40;
  constexpr int sides = 4;
  constexpr int of_a_box = columns * rows * sides;
  constexpr double depth = 0.2;
  constexpr std::array<double, 3> tilts{0.0, 30.0, 60.0};
  int const boxes = (louvres + of_a_box - 1) / of_a_box;
  int const across = static_cast<int>(std::ceil(std::sqrt(boxes)));
  auto const corner = [&](int box) {
    return 17.0 * glm::dvec3(box % across, (box - box % across) / across, 0);
  };
  Scene scene;
  for (int i = 0; i < louvres; ++i) {
    int const column = i % columns;
    int const side = i / columns % sides;
    int const row = i / (columns * sides) % rows;
    double const tilt = tilts.at(static_cast<std::size_t>(row + column) % 3) * degree;
    glm::dvec3 const inner(0.1 + 1.1 * column, -0.05, 0.22 + 0.25 * row);
    glm::dvec3 const out = depth * glm::dvec3(0.0, -std::cos(tilt), -std::sin(tilt));
    scene.add({"louvre",
               on_side(side, corner(i / of_a_box), parallelogram(inner + out, {1, 0, 0}, -out))});
  }
  for (int box = 0; box < boxes; ++box) {
    for (int side = 0; side < sides; ++side) {
      scene.add({"wall", on_side(side, corner(box), south_facing(0, 0, 0, 10, 10))});
    }
    scene.add({"roof", on_side(0, corner(box), level(0, 0, 10, 10, 10))});
  }
  return scene;
}

// By direction and louvre.
using Fractions = std::vector<std::vector<double>>;

// The louvre's area towards each sun, m2; 0 where it is turned away.
std::vector<std::vector<double>> projected_areas(Scene const& scene, int louvres) {
  std::vector<std::vector<double>> areas;
  for (SunDirection const sun : suns()) {
    std::vector<double>& row = areas.emplace_back();
    for (int i = 0; i < louvres; ++i) {
      Polygon const& polygon = scene[static_cast<SurfaceId>(i)].polygon;
      double const cosine = glm::dot(normal(polygon), to_vector(sun));
      row.push_back(cosine > edge_on ? area(polygon) * cosine : 0.0);
    }
  }
  return areas;
}

struct Answer {
  Fractions fractions;
  double milliseconds = 0.0;  // a direction
};

// Once before, which lays out tiles.
template <typename Ask>
Answer timed(int times, Ask ask) {
  Answer answer{ask(), std::numeric_limits<double>::infinity()};
  for (int i = 0; i < times; ++i) {
    auto const start = std::chrono::steady_clock::now();
    answer.fractions = ask();
    std::chrono::duration<double, std::milli> const took = std::chrono::steady_clock::now() - start;
    answer.milliseconds = std::min(answer.milliseconds, took.count() / directions);
  }
  return answer;
}

Answer by_views(Scene const& scene, std::vector<std::vector<double>> const& areas, double error,
                int times) {
  RendererOptions options;
  options.error = error;
  Renderer renderer(scene, options);
  std::vector<SurfaceId> asked(areas.front().size());
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = static_cast<SurfaceId>(i);
  return timed(times, [&] {
    auto const sunlit = renderer.projected_sunlit_areas(suns(), asked);
    Fractions fractions = areas;
    for (std::size_t sun = 0; sun < areas.size(); ++sun) {
      for (std::size_t i = 0; i < asked.size(); ++i) {
        double& fraction = fractions[sun][i];
        if (fraction > 0.0) fraction = sunlit[sun][i].projected_area / fraction;
      }
    }
    return fractions;
  });
}

struct Off {
  double mean = 0.0;
  double of_99 = 0.0;  // 99 of a hundred are off by less
};

// Errors of the louvres that face the sun.
Off off(Fractions const& fractions, Fractions const& right,
        std::vector<std::vector<double>> const& areas) {
  std::vector<double> errors;
  double sum = 0.0;
  for (std::size_t sun = 0; sun < areas.size(); ++sun) {
    for (std::size_t i = 0; i < areas[sun].size(); ++i) {
      if (areas[sun][i] <= 0.0) continue;
      errors.push_back(std::abs(fractions[sun][i] - right[sun][i]));
      sum += errors.back();
    }
  }
  auto const place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
  std::nth_element(errors.begin(), place, errors.end());
  return {sum / static_cast<double>(errors.size()), *place};
}

void print_row(int louvres, double error, Answer const& answer, Off const& off) {
  std::printf("%7d   %6g %14.1f ms   %.1e   %.1e\n", louvres, error, answer.milliseconds, off.mean,
              off.of_99);
  std::fflush(stdout);
}

void print_table() {
  std::printf("%s\n", Renderer(louvred_boxes(1), {}).device().renderer.c_str());
  std::printf("louvres    error       a direction      mean   99 of a hundred\n");
  for (int const louvres : {400, 2000, 8000, 32000}) {
    Scene const scene = louvred_boxes(louvres);
    auto const areas = projected_areas(scene, louvres);
    Fractions const right = by_views(scene, areas, 1e-4, 0).fractions;
    for (double const error : {1e-3, 1e-2, 1e-1}) {
      Answer const answer = by_views(scene, areas, error, repeats);
      print_row(louvres, error, answer, off(answer.fractions, right, areas));
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("shading_receivers", gpu_shading::print_table); }
