#include "gpu_shading/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

#include "gpu_shading/transmittance.h"
#include "support/mean_of_rays.h"
#include "support/random_scene.h"
#include "support/refusal.h"
#include "support/shapes.h"
#include "support/transparent_case.h"

namespace gpu_shading {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<Transmittance const> constant(double value) {
  return std::make_shared<Transmittance const>(Transmittance::constant(value));
}

// What a ray meets, in long double: every surface in turn, its plane first, then how often its
// rings wind about the point in the plane.
class Reference {
 public:
  struct Answer {
    double transmittance = 1.0;
    std::optional<RayHit> nearest;
    long double margin = std::numeric_limits<long double>::infinity();  // from an edge or an end, m
  };

  explicit Reference(Scene const& scene) {
    for (SurfaceId id = 0; id < scene.size(); ++id) {
      Flat& flat = surfaces_.emplace_back();
      flat.surface = &scene[id];
      Ring const& ring = scene[id].polygon.outline;
      if (ring.size() < 3) continue;
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        flat.normal = plus(flat.normal, cross(minus(of(ring[i]), of(ring[0])),
                                              minus(of(ring[i + 1]), of(ring[0]))));
      }
      long double const size = std::sqrt(dot(flat.normal, flat.normal));
      if (size < 1e-12L) continue;
      for (long double& x : flat.normal) x /= size;
      flat.u = minus(of(ring[1]), of(ring[0]));
      long double const length = std::sqrt(dot(flat.u, flat.u));
      for (long double& x : flat.u) x /= length;
      flat.v = cross(flat.normal, flat.u);
      flat.corner = of(ring[0]);
      flat.rings.push_back(flat.in_plane(ring));
      for (glm::dvec3 const& vertex : ring) {
        Vector const away = minus(of(vertex), flat.corner);
        flat.radius = std::max(flat.radius, std::sqrt(dot(away, away)));
      }
      for (Ring const& hole : scene[id].polygon.holes) flat.rings.push_back(flat.in_plane(hole));
    }
  }

  Answer operator()(Ray const& ray, std::span<double const> factors) const {
    Answer answer;
    Vector const origin = of(ray.origin);
    Vector direction = of(ray.direction);
    long double const size = std::sqrt(dot(direction, direction));
    for (long double& x : direction) x /= size;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      Flat const& flat = surfaces_[i];
      if (flat.rings.empty() || flat.surface->casting == Casting::never) continue;
      Vector const aside = cross(minus(flat.corner, origin), direction);
      if (dot(aside, aside) > flat.radius * flat.radius * 1.0001L) continue;
      long double const cosine = dot(flat.normal, direction);
      long double const height = dot(flat.normal, minus(flat.corner, origin));
      if (cosine == 0.0L || height == 0.0L) continue;
      long double const distance = height / cosine;
      Vector at = origin;
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += distance * direction[axis];
      Point const point = flat.in_plane(at);
      int windings = 0;
      long double margin = std::numeric_limits<long double>::infinity();
      for (auto const& ring : flat.rings) {
        windings += winding(ring, point) != 0 ? 1 : 0;
        margin = std::min(margin, from_edges(ring, point));
      }
      bool const inside = windings % 2 == 1;
      if (inside) {
        margin = std::min({margin, std::abs(height), std::abs(distance - ray.length)});
      } else if (distance < 0.0L || distance > static_cast<long double>(ray.length)) {
        continue;
      }
      answer.margin = std::min(answer.margin, margin);
      if (!inside || distance < 0.0L || distance > static_cast<long double>(ray.length)) continue;
      if (flat.surface->casting == Casting::turned_away && cosine > 1e-3L) continue;
      double const passed = transmittance(*flat.surface, cosine, factors);
      answer.transmittance *= passed;
      auto const here = static_cast<double>(distance);
      if (passed == 0.0 && (!answer.nearest || here < answer.nearest->distance)) {
        answer.nearest = RayHit{static_cast<SurfaceId>(i), here};
      }
    }
    return answer;
  }

 private:
  using Vector = std::array<long double, 3>;
  using Point = std::array<long double, 2>;

  struct Flat {
    Surface const* surface = nullptr;
    Vector corner{};
    Vector u{};
    Vector v{};
    Vector normal{};
    long double radius = 0.0L;  // about the corner
    std::vector<std::vector<Point>> rings;

    Point in_plane(Vector const& at) const {
      return {dot(minus(at, corner), u), dot(minus(at, corner), v)};
    }
    std::vector<Point> in_plane(Ring const& ring) const {
      std::vector<Point> points;
      for (glm::dvec3 const& vertex : ring) points.push_back(in_plane(of(vertex)));
      return points;
    }
  };

  static Vector of(glm::dvec3 const& v) { return {v.x, v.y, v.z}; }
  static Vector plus(Vector const& a, Vector const& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  }
  static Vector minus(Vector const& a, Vector const& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static long double dot(Vector const& a, Vector const& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Vector cross(Vector const& a, Vector const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  // After Sunday (2001).
  static int winding(std::vector<Point> const& ring, Point const& p) {
    int number = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Point const& a = ring[i];
      Point const& b = ring[(i + 1) % ring.size()];
      long double const left = (b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1]);
      if (a[1] <= p[1] && b[1] > p[1] && left > 0.0L) ++number;
      if (a[1] > p[1] && b[1] <= p[1] && left < 0.0L) --number;
    }
    return number;
  }

  static long double from_edges(std::vector<Point> const& ring, Point const& p) {
    long double least = std::numeric_limits<long double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Point const& a = ring[i];
      Point const& b = ring[(i + 1) % ring.size()];
      Point const along{b[0] - a[0], b[1] - a[1]};
      Point const away{p[0] - a[0], p[1] - a[1]};
      long double const square = along[0] * along[0] + along[1] * along[1];
      long double const share =
          std::clamp((away[0] * along[0] + away[1] * along[1]) / square, 0.0L, 1.0L);
      Point const aside{away[0] - share * along[0], away[1] - share * along[1]};
      least = std::min(least, aside[0] * aside[0] + aside[1] * aside[1]);
    }
    return std::sqrt(least);
  }

  static double transmittance(Surface const& surface, long double cosine,
                              std::span<double const> factors) {
    if (!surface.filter.transmits()) return 0.0;
    double passed = 1.0;
    if (auto const* const shade = surface.filter.find<AngularTransmittance>()) {
      passed = (*shade->model)(std::acos(std::min(1.0, std::abs(static_cast<double>(cosine)))));
    }
    if (surface.filter.schedule >= 0)
      passed *= factors[static_cast<std::size_t>(surface.filter.schedule)];
    return passed;
  }

  std::vector<Flat> surfaces_;
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  std::size_t below(std::size_t count) { return engine_() % count; }
  glm::dvec3 direction() {
    glm::dvec3 v(0.0);
    do {
      v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (glm::dot(v, v) > 1.0 || glm::dot(v, v) < 1e-4);
    return glm::normalize(v);
  }

 private:
  std::mt19937 engine_;
};

constexpr std::array factors{0.25, 0.75, 0.0};

// Convex and non-convex polygons, and some with holes; most of them transmit.
Scene mixed_scene(std::uint32_t seed, Random& random) {
  Scene scene;
  for (std::uint32_t part = 0; part < 6; ++part) {
    RandomScene const given = random_scene(6 * seed + part);
    for (SurfaceId id = 0; id < given.scene.size(); ++id) {
      Surface surface = given.scene[id];
      // Nearer to one another, so that rays meet several.
      glm::dvec3 const by = -0.8 * glm::round(surface.polygon.outline.front());
      for (glm::dvec3& vertex : surface.polygon.outline) vertex += by;
      for (Ring& hole : surface.polygon.holes) {
        for (glm::dvec3& vertex : hole) vertex += by;
      }
      std::size_t const kind = random.below(8);
      if (kind < 3) surface.filter.set(AngularTransmittance{constant(random.between(0.1, 0.95))});
      if (kind == 3)
        surface.filter.set(
            AngularTransmittance{std::make_shared<Transmittance const>(two_panes())});
      if (kind == 2 || kind == 4) surface.filter.schedule = static_cast<int>(random.below(2));
      if (kind == 5 && random.below(4) == 0) surface.filter.schedule = 2;
      if (random.below(8) == 0) surface.casting = Casting::turned_away;
      if (random.below(10) == 0) surface.casting = Casting::never;
      scene.add(std::move(surface));
    }
  }
  scene.add({"no area", {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {}}});
  scene.add({"two vertices", {{{0, 0, 0}, {1, 1, 1}}, {}}});
  return scene;
}

glm::dvec3 point_near(Surface const& surface, Random& random) {
  Ring const& ring = surface.polygon.outline;
  glm::dvec3 point(0.0);
  double sum = 0.0;
  for (glm::dvec3 const& vertex : ring) {
    double const weight = random.between(0.0, 1.0);
    point += weight * vertex;
    sum += weight;
  }
  return point / sum;
}

TEST(Rays, AMillionAgreeWithWindingNumbersInLongDouble) {
  Random random(1);
  int met = 0;
  int hidden = 0;
  int at_edges = 0;
  for (std::uint32_t seed = 0; seed < 25; ++seed) {
    Scene const scene = mixed_scene(seed, random);
    RayScene const rays(scene);
    Reference const reference(scene);
    for (int i = 0; i < 40000; ++i) {
      Ray ray;
      ray.origin = point_near(scene[static_cast<SurfaceId>(random.below(scene.size()))], random) +
                   random.between(0.0, 3.0) * random.direction();
      int const kind = i % 4;
      if (kind == 0) {
        ray.direction = random.direction();
      } else if (kind == 1) {
        ray.direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0 : -1.0;
      } else {
        auto const target = static_cast<SurfaceId>(random.below(scene.size()));
        ray.direction = point_near(scene[target], random) - ray.origin;
      }
      if (random.below(3) == 0) ray.length = random.between(0.0, 12.0);
      Reference::Answer const expected = reference(ray, factors);
      if (expected.margin < 1e-9L) {
        ++at_edges;
        continue;
      }
      RayConditions const conditions{.factors = factors};
      double const answer = rays.transmittance(ray, conditions);
      ASSERT_NEAR(answer, expected.transmittance, 1e-12) << "scene " << seed << ", ray " << i;
      std::optional<RayHit> const nearest = rays.nearest_opaque(ray, conditions);
      ASSERT_EQ(nearest.has_value(), expected.nearest.has_value()) << seed << ", " << i;
      if (nearest) {
        ASSERT_EQ(nearest->surface, expected.nearest->surface);
        // Up to 1e-4 from the plane's direction.
        ASSERT_NEAR(nearest->distance, expected.nearest->distance, 1e-9);
        ++hidden;
      }
      if (answer > 0.0 && answer < 1.0) ++met;
    }
  }
  EXPECT_GT(met, 200000);
  EXPECT_GT(hidden, 200000);
  EXPECT_LT(at_edges, 100);
}

// Small panes in a cube of 20 m about a place, as many as a mesh has.
Scene many_panes(int count, glm::dvec3 const& about, Random& random) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const corner(random.between(-10, 10), random.between(-10, 10),
                            random.between(-10, 10));
    Surface pane{"pane",
                 parallelogram(about + corner, random.direction(), 0.7 * random.direction())};
    if (i % 8 != 0) pane.filter.set(AngularTransmittance{constant(0.9)});
    scene.add(std::move(pane));
  }
  return scene;
}

// On a national grid, and seen from far away.
TEST(Rays, AgreeInLargeScenesFarFromTheAxes) {
  Random random(5);
  int met = 0;
  for (double const far : {0.0, 5e5}) {
    glm::dvec3 const about(far, -0.3 * far, 0.0);
    Scene const scene = many_panes(3000, about, random);
    RayScene const rays(scene);
    Reference const reference(scene);
    for (int i = 0; i < 3000; ++i) {
      double const away = i % 3 == 0 ? 10.0 : i % 3 == 1 ? 1e3 : 1e5;
      glm::dvec3 const target(random.between(-10, 10), random.between(-10, 10),
                              random.between(-10, 10));
      glm::dvec3 const direction = random.direction();
      Ray const ray{about + target - away * direction, direction};
      Reference::Answer const expected = reference(ray, {});
      if (expected.margin < 1e-8L) continue;
      ASSERT_NEAR(rays.transmittance(ray), expected.transmittance, 1e-9) << far << ", " << i;
      std::optional<RayHit> const nearest = rays.nearest_opaque(ray);
      ASSERT_EQ(nearest.has_value(), expected.nearest.has_value()) << far << ", " << i;
      if (!nearest) continue;
      ASSERT_EQ(nearest->surface, expected.nearest->surface) << far << ", " << i;
      ++met;
    }
  }
  EXPECT_GT(met, 1000);
}

double sunlit_fraction(Scene const& scene, SunDirection sun) {
  Renderer renderer = renderer_of(scene, 512, on_cpu);
  double const cosine = glm::dot(normal(scene[0].polygon), to_vector(sun));
  return sunlit(renderer, sun, 0).at(factors) / (area(scene[0].polygon) * cosine);
}

TEST(Rays, HaveTheRenderersSunlitFractionAsTheirMean) {
  Random random(2);
  double largest = 0.0;
  int shaded = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    RandomScene const given = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < given.scene.size(); ++id) {
      Surface surface = given.scene[id];
      std::size_t const kind = random.below(5);
      if (kind == 1)
        surface.filter.set(
            AngularTransmittance{std::make_shared<Transmittance const>(two_panes())});
      if (kind == 2) surface.filter.schedule = static_cast<int>(random.below(2));
      if (kind == 3) surface.casting = Casting::turned_away;
      scene.add(std::move(surface));
    }
    double const rendered = sunlit_fraction(scene, given.sun);
    double const mean = mean_of_rays(RayScene(scene), scene[0].polygon, given.sun,
                                     {.receiver = 0, .factors = factors});
    // 512 pixels and some 40,000 points are each within 2e-3.
    EXPECT_NEAR(mean, rendered, 3e-3) << "seed " << seed;
    largest = std::max(largest, std::abs(mean - rendered));
    if (rendered < 0.99) ++shaded;
  }
  EXPECT_GT(shaded, 40);
  RecordProperty("largest", std::to_string(largest));
}

Scene one_wall(Surface surface = {"wall", south_facing(0, 0, 0, 2, 2)}) {
  Scene scene;
  scene.add(std::move(surface));
  return scene;
}

Ray northwards(double x, double z, double length = infinity) {
  return {{x, -5.0, z}, {0, 1, 0}, length};
}

TEST(Rays, MeetWhatIsBetweenTheirEnds) {
  RayScene const rays(one_wall());
  EXPECT_EQ(rays.transmittance(northwards(1, 1)), 0.0);
  EXPECT_EQ(rays.transmittance(northwards(3, 1)), 1.0);
  EXPECT_EQ(rays.transmittance(northwards(1, 1, 4.9)), 1.0);
  EXPECT_EQ(rays.transmittance(northwards(1, 1, 5.1)), 0.0);
  EXPECT_EQ(rays.transmittance(northwards(1, 1, -1.0)), 1.0);
  EXPECT_EQ(rays.transmittance({{1, -5, 1}, {0, -1, 0}}), 1.0);
  auto const hit = rays.nearest_opaque({{1, -5, 1}, {0, 100, 0}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, 0U);
  EXPECT_DOUBLE_EQ(hit->distance, 5.0);
  EXPECT_FALSE(rays.nearest_opaque(northwards(1, 1, 4.9)));
}

TEST(Rays, DoNotMeetASurfaceInWhosePlaneTheyBeginOrEnd) {
  RayScene const rays(one_wall());
  for (double const y : {0.0, 1e-10, -1e-10}) {
    EXPECT_EQ(rays.transmittance({{1, y, 1}, {0, 1, 0}}), 1.0) << y;
    EXPECT_EQ(rays.transmittance({{1, y, 1}, {0.3, -1, 0}}), 1.0) << y;
    EXPECT_EQ(rays.transmittance({{1, y, 1}, {1, 0, 0}}), 1.0) << y;
    EXPECT_EQ(rays.transmittance(northwards(1, 1, 5.0 + y)), 1.0) << y;
  }
  EXPECT_EQ(rays.transmittance({{1, -1e-8, 1}, {0, 1, 0}}), 0.0);
  EXPECT_EQ(rays.transmittance({{1, 1e-8, 1}, {0, -1, 0}}), 0.0);
  EXPECT_EQ(rays.transmittance(northwards(1, 1, 5.0 + 1e-8)), 0.0);
}

TEST(Rays, MeetASurfaceOnceAtTheEdgesWithinIt) {
  // An L of which two corners are in line with the ray, a star with a hole, and a twisted sheet of
  // two triangles: rays through the lines that a triangulation may have.
  Polygon const l{{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}}, {}};
  Polygon const twisted{{{0, 0, 0}, {2, 0, 0}, {2, 0.5, 2}, {0, 0, 2}}, {}};
  Polygon holed = south_facing(0, 0, 0, 2, 2);
  holed.holes = {south_facing(0.5, 0, 0.5, 0.5, 1).outline};
  for (Polygon const& polygon : {l, twisted, holed}) {
    RayScene const rays(
        one_wall({"sheet", polygon, Casting::always, {{AngularTransmittance{constant(0.5)}}}}));
    for (int i = 1; i < 400; ++i) {
      double const x = i / 200.0;
      for (Ray const& ray :
           {northwards(x, x), northwards(x, 0.5), northwards(0.25, x),
            Ray{{x - 5, -5, x + 5}, {1, 1, -1}}, Ray{{0.25 + x, -x, 0.25}, {-1, 1, 0}}}) {
        double const passed = rays.transmittance(ray);
        EXPECT_TRUE(passed == 0.5 || passed == 1.0) << passed;
      }
      if (polygon.holes.empty()) {
        EXPECT_EQ(rays.transmittance(northwards(0.3, x)), 0.5) << x;
      }
    }
  }
  RayScene const rays(
      one_wall({"sheet", holed, Casting::always, {{AngularTransmittance{constant(0.5)}}}}));
  EXPECT_EQ(rays.transmittance(northwards(0.75, 1.0)), 1.0);
  EXPECT_EQ(rays.transmittance(northwards(0.75, 0.25)), 0.5);
}

TEST(Rays, AreNotLostBetweenSurfacesThatMeet) {
  // A closed box, seen from within: through its edges and corners as well.
  Scene scene;
  glm::dvec3 const x(3, 0, 0);
  glm::dvec3 const y(0, 4, 0);
  glm::dvec3 const z(0, 0, 2.7);
  glm::dvec3 const low(0.1, 0.2, 0.3);
  for (auto const& [a, b, c] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
    scene.add({"near", parallelogram(low, a, b)});
    scene.add({"far", parallelogram(low + c, b, a)});
  }
  RayScene const rays(scene, {.faces = RayFaces::both});
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    glm::dvec3 const origin = low + glm::dvec3(1.5, 2.0, 1.35) + random.direction();
    glm::dvec3 target = low;
    for (int axis = 0; axis < 3; ++axis) {
      double const share = static_cast<double>(random.below(3)) / 2.0;
      target += share * (axis == 0 ? x : axis == 1 ? y : z);
    }
    if (glm::distance(target, origin) < 0.5) continue;
    EXPECT_EQ(rays.transmittance({origin, target - origin}), 0.0);
  }
}

TEST(Rays, TakeTheFacesThatTheyAreToldTo) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 2, 2), Casting::turned_away});
  scene.add({"window", south_facing(4, 0, 0, 2, 2), Casting::never});
  Ray const from_behind{{1, 5, 1}, {0, -1, 0}};
  RayScene const as_casting(scene);
  EXPECT_EQ(as_casting.transmittance(from_behind), 1.0);  // towards a sun in the south: it is lit
  EXPECT_EQ(as_casting.transmittance(northwards(1, 1)), 0.0);
  RayScene const both(scene, {.faces = RayFaces::both});
  EXPECT_EQ(both.transmittance(from_behind), 0.0);
  EXPECT_EQ(both.transmittance(northwards(1, 1)), 0.0);
  EXPECT_EQ(both.transmittance(northwards(5, 1)), 1.0);
  RayScene const listed(scene, {.faces = RayFaces::both, .casters = std::vector<SurfaceId>{1, 1}});
  EXPECT_EQ(listed.transmittance(northwards(5, 1)), 0.0);
  EXPECT_EQ(listed.transmittance(northwards(1, 1)), 1.0);
}

TEST(Rays, FollowTheShadingRuleAndPassExcludedSurfacesOver) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    scene.add({"sheet",
               south_facing(0, i, 0, 2, 2),
               Casting::always,
               {{AngularTransmittance{constant(0.5)}}}});
  }
  ShadingRule rule{std::vector<ShadingRule::Role>(3), 1, {1}};
  for (SurfaceId id = 0; id < 3; ++id) rule.roles[id].wall = id;
  rule.roles[1].shades = ShadingRule::Shades::own_wall;
  scene.set_rule(rule);
  RayScene const rays(scene);
  EXPECT_EQ(rays.transmittance(northwards(1, 1)), 0.125);
  EXPECT_EQ(rays.transmittance(northwards(1, 1), {.receiver = 2}), 0.5);
  EXPECT_EQ(rays.transmittance(northwards(1, 1), {.receiver = 1}), 0.25);
  std::array<SurfaceId, 2> const excluded{0, 2};
  EXPECT_EQ(rays.transmittance(northwards(1, 1), {.excluded = excluded}), 0.5);
}

TEST(Rays, FollowTransmittancesByAngleAndSchedules) {
  Scene scene;
  scene.add({"glass",
             south_facing(0, 0, 0, 9, 9),
             Casting::always,
             {{AngularTransmittance{std::make_shared<Transmittance const>(two_panes())}}}});
  scene.add({"tree", south_facing(0, 1, 0, 9, 9), Casting::always, {{}, 1}});
  RayScene const rays(scene);
  double const glass = two_panes()(std::numbers::pi / 3.0);
  Ray const through{{-5, -4, 1}, {std::sqrt(3.0), 1, 0}};  // 60 degrees from the normal
  EXPECT_NEAR(rays.transmittance(through), glass, 1e-12);
  EXPECT_NEAR(rays.transmittance(through, {.factors = factors}), 0.75 * glass, 1e-12);
  std::array<double, 2> const shut{1.0, 0.0};
  auto const hit = rays.nearest_opaque(through, {.factors = shut});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, 1U);
  EXPECT_NEAR(hit->distance, 10.0, 1e-12);
  EXPECT_FALSE(rays.nearest_opaque(through, {.factors = factors}));
}

TEST(Rays, NameTheSurfacesOnTheirWayUpToAnOpaqueOne) {
  Scene scene;
  scene.add({"far", south_facing(0, 3, 0, 9, 9)});
  scene.add({"glass",
             south_facing(0, 0, 0, 9, 9),
             Casting::always,
             {{AngularTransmittance{
                 std::make_shared<Transmittance const>(Transmittance::constant(0.5))}}}});
  scene.add({"tree", south_facing(0, 1, 0, 9, 9), Casting::always, {{}, 1}});
  scene.add({"near", south_facing(0, 2, 0, 9, 9)});
  RayScene const rays(scene);
  auto const met = rays.layers(northwards(1, 1), {.factors = factors});
  ASSERT_EQ(met.size(), 3U);
  std::array<SurfaceId, 3> const order{1, 2, 3};
  std::array<double, 3> const transmittances{0.5, 0.75, 0.0};
  for (std::size_t i = 0; i < met.size(); ++i) {
    EXPECT_EQ(met[i].surface, order[i]);
    EXPECT_DOUBLE_EQ(met[i].distance, 5.0 + static_cast<double>(i));
    EXPECT_EQ(met[i].transmittance, transmittances[i]);
  }
  EXPECT_EQ(rays.layers(northwards(1, 1, 6.5)).size(), 2U);
  EXPECT_TRUE(rays.layers(northwards(-1, 1)).empty());
}

TEST(Rays, DoNotMeetTheSurfaceThatTheyBeginOn) {
  RayScene const rays(one_wall());
  std::array<Ray, 2> both{northwards(1, 1), northwards(1, 1)};
  both[1].from = 0;
  EXPECT_EQ(rays.transmittance(both[0]), 0.0);
  EXPECT_EQ(rays.transmittance(both[1]), 1.0);
  std::array<std::vector<RayLayer>, 2> layers;
  rays.layers(both, {}, layers);
  EXPECT_EQ(layers[0].size(), 1U);
  EXPECT_TRUE(layers[1].empty());
}

TEST(Rays, MayBeAskedFromSeveralThreads) {
  Random random(4);
  Scene const scene = mixed_scene(40, random);
  RayScene const rays(scene);
  std::vector<Ray> all;
  all.reserve(20000);
  for (int i = 0; i < 20000; ++i) {
    all.push_back({point_near(scene[static_cast<SurfaceId>(random.below(scene.size()))], random),
                   random.direction()});
  }
  RayConditions const conditions{.factors = factors};
  std::vector<double> alone;
  alone.reserve(all.size());
  for (Ray const& ray : all) alone.push_back(rays.transmittance(ray, conditions));
  std::vector<std::vector<double>> answers(4, std::vector<double>(all.size()));
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& own : answers) {
    threads.emplace_back([&] { rays.transmittances(all, conditions, own); });
  }
  for (std::thread& thread : threads) thread.join();
  for (auto const& own : answers) EXPECT_EQ(own, alone);
}

TEST(Rays, RefuseWhatIsNoRay) {
  RayScene const rays(one_wall());
  auto const refusal = [&](Ray const& ray) { return refusal_of([&] { rays.transmittance(ray); }); };
  EXPECT_EQ(refusal({{0, 0, 0}, {0, 0, 0}}),
            "a ray's direction is (0, 0, 0), expected finite numbers that are not all 0");
  EXPECT_EQ(refusal({{0, 0, 0}, {0, not_a_number, 1}}),
            "a ray's direction is (0, nan, 1), expected finite numbers that are not all 0");
  EXPECT_EQ(refusal({{0, 0, 0}, {infinity, 0, 1}}),
            "a ray's direction is (inf, 0, 1), expected finite numbers that are not all 0");
  EXPECT_EQ(refusal({{not_a_number, 0, 0}, {0, 1, 0}}),
            "a ray's origin is (nan, 0, 0), expected finite numbers");
  EXPECT_EQ(refusal({{0, 0, 0}, {0, 1, 0}, not_a_number}), "a ray's length is not a number");
  EXPECT_EQ(rays.transmittance({{1, -5, 1}, {0, 1e-200, 0}}), 0.0);
  EXPECT_EQ(rays.transmittance({{1, -5, 1}, {0, 1e200, 0}}), 0.0);
  EXPECT_EQ(refusal_of([&] { rays.transmittance(northwards(1, 1), {.receiver = 7}); }),
            "there is no surface 7 for a ray to ask for: the scene has 1");
  EXPECT_EQ(refusal_of([&] {
              RayScene(one_wall(), {.casters = std::vector<SurfaceId>{0, 3}});
            }),
            "there is no surface 3 for rays to meet: the scene has 1");
  std::vector<Ray> const two(2, northwards(1, 1));
  std::vector<double> one(1);
  EXPECT_EQ(refusal_of([&] { rays.transmittances(two, {}, one); }),
            "1 results for 2 rays, expected as many");
}

TEST(Rays, OfAnEmptySceneMeetNothing) {
  RayScene const rays((Scene()));
  EXPECT_EQ(rays.transmittance(northwards(1, 1)), 1.0);
  EXPECT_FALSE(rays.nearest_opaque(northwards(1, 1)));
}

}  // namespace
}  // namespace gpu_shading
