#include "support/random_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "support/shapes.h"

namespace gpu_shading {
namespace {

// Each call is a statement of its own: compilers differ in the order of a function's arguments.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  // Implemented here because the standard's distributions differ between libraries.
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int whole(int low, int high) { return static_cast<int>(std::floor(between(low, high + 1))); }

  glm::dvec3 direction() {
    double const z = between(-1.0, 1.0);
    double const turn = between(0.0, 2.0 * std::numbers::pi);
    double const level = std::sqrt(1.0 - z * z);
    return {level * std::cos(turn), level * std::sin(turn), z};
  }

 private:
  std::mt19937 engine_;
};

struct Axes {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 normal;

  Axes(glm::dvec3 const& towards, Random& random) : normal(towards) {
    right = glm::normalize(glm::cross(normal, random.direction()));
    up = glm::cross(normal, right);
  }
};

Ring ring_about(glm::dvec3 const& centre, Axes const& axes, std::vector<double> const& radii,
                double start) {
  Ring ring;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    double const turn =
        start + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
    ring.push_back(centre + radii[i] * (axes.right * std::cos(turn) + axes.up * std::sin(turn)));
  }
  return ring;
}

Polygon random_polygon(Random& random, glm::dvec3 const& centre, Axes const& axes, double radius) {
  double const start = random.between(0.0, 6.0);
  int const kind = random.whole(0, 2);
  if (kind == 1) {
    std::vector<double> star(static_cast<std::size_t>(random.whole(6, 12)));
    for (double& r : star) r = radius * random.between(0.25, 1.0);
    return {ring_about(centre, axes, star, start), {}};
  }
  std::vector<double> const round(static_cast<std::size_t>(random.whole(3, 8)), radius);
  Polygon polygon{ring_about(centre, axes, round, start), {}};
  if (kind == 2) {
    // Inside the inscribed circle of a triangle.
    std::vector<double> const inner(4, radius * random.between(0.15, 0.45));
    Ring hole = ring_about(centre, axes, inner, random.between(0.0, 6.0));
    if (random.whole(0, 1) == 1) std::reverse(hole.begin(), hole.end());
    polygon.holes.push_back(hole);
  }
  return polygon;
}

}  // namespace

RandomScene random_scene(std::uint32_t seed) {
  Random random(seed);
  RandomScene result;
  Axes const axes(random.direction(), random);
  double const up = random.between(0.0, 20.0);
  double const north = random.between(-20.0, 20.0);
  double const east = random.between(-20.0, 20.0);
  glm::dvec3 const centre(east, north, up);
  double const radius = random.between(0.5, 3.0);
  result.scene.add({"receiver", random_polygon(random, centre, axes, radius)});

  glm::dvec3 towards_sun(0.0);
  while (glm::dot(towards_sun, axes.normal) < 0.1) towards_sun = random.direction();
  result.sun = to_direction(towards_sun);

  int const casters = random.whole(1, 6);
  for (int i = 0; i < casters; ++i) {
    // On or near a ray from the receiver, so that most of them shade it.
    double const away = random.between(0.1, 8.0);
    double const upwards = random.between(-1.0, 1.0);
    double const sideways = random.between(-1.0, 1.0);
    glm::dvec3 const at =
        centre + towards_sun * away + radius * (axes.right * sideways + axes.up * upwards);
    Axes const tilt(random.direction(), random);
    result.scene.add(
        {"caster", random_polygon(random, at, tilt, radius * random.between(0.2, 1.0))});
  }
  return result;
}

Scene triangle_soup(int count, std::uint32_t seed) {
  std::mt19937 generator(seed);
  auto const between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / std::mt19937::max();
  };
  Scene scene;
  scene.add({"receiver", south_facing(0, 0, 0, 3, 2)});
  for (int i = 0; i < count; ++i) {
    double const height = between(-0.5, 3.5);
    double const behind = between(-2.0, -0.2);
    glm::dvec3 const corner(between(-1, 4), behind, height);
    double const size = 6.0 / std::sqrt(count) * between(0.2, 1.0);
    auto const edge = [&] {
      double const z = between(-0.5, 0.5);
      double const y = between(-0.09, 0.09);
      return size * glm::dvec3(between(-0.5, 0.5), y, z);
    };
    glm::dvec3 const a = edge();
    scene.add({"leaf", {{corner, corner + a, corner + edge()}, {}}});
  }
  return scene;
}

}  // namespace gpu_shading
