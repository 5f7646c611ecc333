#include "support/crowds.h"

#include <cmath>
#include <random>

#include "support/shapes.h"

namespace gpu_shading {

Scene fine_louvres(int count, double beyond) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  double const depth = 1.0 / count;
  for (int i = 0; i < count; ++i) {
    double const height = 2.0 * (i + 0.5) / count;
    scene.add({"louvre", parallelogram({-beyond, -0.1 - depth, height}, {3 + 2 * beyond, 0, 0},
                                       {0, depth, 0.4 * depth})});
  }
  return scene;
}

Scene pieces_of_louvres(int count) {
  constexpr int louvres = 20;
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  auto const rounded = [](double coordinate) { return std::round(coordinate * 1e5) * 1e-5; };
  int const pieces = count / louvres;
  double const pitch = 3.0 / pieces;
  for (int louvre = 0; louvre < louvres; ++louvre) {
    double const z = 2.0 - 0.1 * louvre;
    for (int piece = 0; piece < pieces; ++piece) {
      double const from = rounded((piece + 0.025) * pitch);
      double const to = rounded((piece + 0.975) * pitch);
      scene.add(
          {"piece", parallelogram({from, -0.13, z - 0.04}, {to - from, 0, 0}, {0, 0.08, 0.04})});
    }
  }
  return scene;
}

Scene mixed_crowd(int count) {
  Scene scene;
  std::mt19937 generator{5};
  auto const between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / std::mt19937::max();
  };
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const corner(between(-1, 4), between(-2, 0.2), between(-1, 4));
    double const size = between(0.02, 0.2);
    glm::dvec3 const a(size, between(-size, size), 0.0);
    glm::dvec3 const b(0.0, between(-size, size), size);
    Surface surface{"caster", parallelogram(corner, a, b)};
    if (i % 4 == 1) surface.polygon.outline.pop_back();
    if (i % 4 == 2) {
      surface.polygon.outline = {corner,
                                 corner + a,
                                 corner + a + 0.3 * b,
                                 corner + 0.3 * a + 0.3 * b,
                                 corner + 0.3 * a + b,
                                 corner + b};
    }
    if (i % 8 == 3) surface.casting = Casting::turned_away;
    if (i % 16 == 4) surface.polygon = south_facing(corner.x, -5e-5, corner.z, size, size);
    scene.add(surface);
  }
  return scene;
}

ShadingRule thirds(Scene const& scene) {
  ShadingRule rule;
  rule.zones = 2;
  rule.zone_shades = {1, 0, 1, 1};
  rule.roles.resize(scene.size());
  for (std::size_t id = 0; id < scene.size(); ++id) {
    rule.roles[id].wall = static_cast<std::uint32_t>(id);
    rule.roles[id].zone = id % 3 == 0 ? 0 : 1;
  }
  return rule;
}

}  // namespace gpu_shading
