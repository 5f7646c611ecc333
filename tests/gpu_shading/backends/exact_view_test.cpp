// Answers without samples, against exact polygon clipping.

#include "backends/exact/exact_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "backends/exact/convex_view.h"
#include "backends/exact/swept_view.h"
#include "gpu_shading/transmittance.h"
#include "scene/casters.h"
#include "support/exact.h"
#include "support/random_scene.h"
#include "support/room.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
// Schedules 0 to 2.
constexpr std::array schedule_factors{0.7, 0.4, 0.0};
// Of the receiver's area: what polygons rounded to 10 nm leave.
constexpr double rounding = 2e-5;

class ExactQuestions {
 public:
  explicit ExactQuestions(Scene const& scene)
      : scene_(scene), casters_(scene), transmission_(scene) {}

  std::optional<std::vector<LuminanceSums>> operator()(
      SunDirection sun, SurfaceId receiver, double most_steps = unlimited,
      std::vector<SurfaceId> const& interiors = {}) {
    Asked const asked(*this, sun, receiver, interiors);
    auto const found = exact_sums(scene_, transmission_, asked.question(), most_steps);
    if (!found) return std::nullopt;
    return std::vector(found->sums.begin(), found->sums.end());
  }

  // By intersections, and by a sweep; false if the first cannot answer.
  bool agree(SunDirection sun, SurfaceId receiver, std::vector<SurfaceId> const& interiors = {}) {
    constexpr double same = 1e-12;
    Asked const asked(*this, sun, receiver, interiors);
    ExactQuestion const question = asked.question();
    Projection const projection(question.frame, question.towards_sun);
    auto const by_intersections = convex_sums(scene_, transmission_, question, projection);
    if (!by_intersections) return false;
    auto const by_sweep = swept_sums(scene_, transmission_, question, projection, unlimited);
    auto const convex = by_intersections->sums;
    auto const swept = by_sweep ? by_sweep->sums : std::span<LuminanceSums const>();
    if (convex.size() != swept.size()) {
      ADD_FAILURE() << "the sweep has another number of parts";
      return true;
    }
    for (std::size_t i = 0; i < swept.size(); ++i) {
      EXPECT_NEAR(convex[i].unscheduled, swept[i].unscheduled, same) << i;
      std::map<std::vector<std::pair<int, int>>, double> differences;
      for (auto const& [powers, sum] : convex[i].scheduled) differences[powers] += sum;
      for (auto const& [powers, sum] : swept[i].scheduled) differences[powers] -= sum;
      for (auto const& [powers, difference] : differences) EXPECT_NEAR(difference, 0.0, same) << i;
    }
    return true;
  }

  // With schedules by their factors, in parts of the receiver.
  double total(LuminanceSums const& sums) const {
    double total = sums.unscheduled;
    for (auto const& part : sums.scheduled) {
      double product = part.sum;
      for (auto const& [number, power] : part.powers) {
        int const schedule = transmission_.schedules()[static_cast<std::size_t>(number)];
        product *= std::pow(schedule_factors.at(static_cast<std::size_t>(schedule)), power);
      }
      total += product;
    }
    return total;
  }

 private:
  // A question, and the polygons that it is about.
  class Asked {
   public:
    Asked(ExactQuestions const& from, SunDirection sun, SurfaceId receiver,
          std::vector<SurfaceId> const& interiors)
        : frame_(plane_frame(from.scene_[receiver].polygon).value()), towards_sun_(to_vector(sun)) {
      auto const add = [&](SurfaceId id, RelativePolygon::Side side) {
        return &polygons_.emplace_back(id, from.scene_[id].polygon, frame_, side);
      };
      receiver_ = add(receiver, RelativePolygon::Side::within);
      InView const in_view = from.casters_.in_view(from.scene_, receiver, frame_, towards_sun_);
      for (SurfaceId const id : in_view.casters) {
        casters_.push_back(add(id, RelativePolygon::Side::in_front));
      }
      for (SurfaceId const id : interiors) {
        interiors_.emplace_back(id, from.scene_[id].polygon, frame_, RelativePolygon::Side::behind);
      }
    }
    ExactQuestion question() const {
      return {*receiver_, frame_, towards_sun_, casters_, !interiors_.empty(), interiors_};
    }

   private:
    PlaneFrame frame_;
    glm::dvec3 towards_sun_;
    std::deque<RelativePolygon> polygons_;
    RelativePolygon const* receiver_;
    std::vector<RelativePolygon const*> casters_;
    std::vector<RelativePolygon> interiors_;
  };

  Scene const& scene_;
  Casters casters_;
  Transmission transmission_;
};

// Gives casters other transmittances and schedules.
Scene with_shades(Scene const& opaque, std::uint32_t seed) {
  Scene scene;
  for (SurfaceId id = 0; id < opaque.size(); ++id) {
    Surface surface = opaque[id];
    std::uint32_t const kind = (seed + 3 * id) % 5;
    if (id > 0 && (kind == 1 || kind == 2)) {
      surface.filter.set(AngularTransmittance{
          std::make_shared<Transmittance const>(Transmittance::polynomial_in_cosine({0.1, 0.7}))});
    }
    if (id > 0 && kind >= 2 && kind <= 3)
      surface.filter.schedule = static_cast<int>((seed + id) % 3);
    scene.add(surface);
  }
  return scene;
}

TEST(ExactView, AgreesWithPolygonClippingBehindRandomPolygons) {
  int shaded = 0;
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene const scene = with_shades(random.scene, seed);
    ExactQuestions ask(scene);
    auto const sums = ask(random.sun, 0);
    ASSERT_TRUE(sums) << seed;
    double const whole = exact::projected_area(scene, random.sun, 0);
    double const expected =
        exact::projected_sunlit_area(scene, random.sun, 0, schedule_factors) / whole;
    EXPECT_NEAR(ask.total(sums->front()), expected, rounding) << seed;
    if (expected < 0.95) ++shaded;
  }
  EXPECT_GT(shaded, 300);
}

TEST(ExactView, AgreesWithPolygonClippingBehindManyTriangles) {
  for (int const count : {10, 100, 400}) {
    Scene const scene = triangle_soup(count, 7);
    ExactQuestions ask(scene);
    SunDirection const sun = sun_at(200, 35);
    auto const sums = ask(sun, 0);
    ASSERT_TRUE(sums);
    double const expected =
        exact::projected_sunlit_area(scene, sun, 0) / exact::projected_area(scene, sun, 0);
    EXPECT_NEAR(sums->front().unscheduled, expected, rounding) << count;
  }
}

TEST(ExactView, OfInteriorSurfacesAgreesWithPolygonClipping) {
  Room room;
  // Before the back wall, so it takes what the floor and the wall would get.
  SurfaceId const table = room.scene.add({"table", level(1, 1, 0.7, 1.5, 1)});
  room.surfaces.insert(room.surfaces.begin(), table);
  Surface blind{"blind", south_facing(1.2, -0.3, 1.0, 0.9, 1.0)};
  blind.filter.schedule = 1;
  room.scene.add(blind);
  room.scene.add({"fin", parallelogram({1.1, -1.0, 0}, {0, 1, 0}, {0, 0, 3})});
  ExactQuestions ask(room.scene);
  for (double azimuth = 110; azimuth < 250; azimuth += 7) {
    for (double altitude = 3; altitude < 80; altitude += 11) {
      SunDirection const sun = sun_at(azimuth, altitude);
      auto const sums = ask(sun, room.window, unlimited, room.surfaces);
      ASSERT_TRUE(sums);
      auto const expected =
          exact::interior_areas(room.scene, sun, room.window, room.surfaces, schedule_factors);
      double const whole = exact::projected_area(room.scene, sun, room.window);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(ask.total((*sums)[i]), expected[i] / whole, rounding)
            << azimuth << ", " << altitude << ": " << room.scene[room.surfaces[i]].name;
      }
    }
  }
}

TEST(ExactView, IsTheSameByIntersectionsAsByASweep) {
  int intersected = 0;
  for (std::uint32_t seed = 1; seed <= 1500; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene const scene = with_shades(random.scene, seed);
    if (ExactQuestions(scene).agree(random.sun, 0)) ++intersected;
    ASSERT_FALSE(testing::Test::HasFailure()) << seed;
  }
  EXPECT_GT(intersected, 150);
}

// A window in a wall with a hole, a table before the back wall, and shades that overlap.
TEST(ExactView, OfARoomIsTheSameByIntersectionsAsByASweep) {
  Room room;
  Polygon east{{{4.0001, 0, 0}, {4.0001, 5, 0}, {4.0001, 5, 3}, {4.0001, 0, 3}},
               {{{4.0001, 1, 1}, {4.0001, 2, 1}, {4.0001, 2, 2}, {4.0001, 1, 2}}}};
  room.surfaces.back() = room.scene.add({"wall with a hole", east});
  room.surfaces.push_back(
      room.scene.add({"in the hole", parallelogram({4.0001, 1, 1}, {0, 1, 0}, {0, 0, 1})}));
  room.surfaces.push_back(room.scene.add({"table", level(1, 1, 0.7, 1.5, 1)}));
  for (int i = 0; i < 3; ++i) {
    Surface blind{"blind", south_facing(0.8 + 0.4 * i, -0.3 - 0.1 * i, 1.0, 0.9, 1.0)};
    if (i > 0) blind.filter.schedule = i % 2;
    room.scene.add(blind);
  }
  room.scene.add({"holed",
                  {{{1, -1, 1}, {3, -1, 1}, {3, -1, 3}, {1, -1, 3}},
                   {{{1.5, -1, 1.5}, {2.5, -1, 1.5}, {2.5, -1, 2.5}, {1.5, -1, 2.5}}}}});
  ExactQuestions ask(room.scene);
  int asked = 0;
  int intersected = 0;
  for (double azimuth = 110; azimuth < 250; azimuth += 3) {
    for (double altitude = 3; altitude < 80; altitude += 5) {
      ++asked;
      if (ask.agree(sun_at(azimuth, altitude), room.window, room.surfaces)) ++intersected;
      ASSERT_FALSE(testing::Test::HasFailure()) << azimuth << ", " << altitude;
    }
  }
  EXPECT_GT(intersected, asked / 2);
}

// In two boxes that pass through one another, each is nearest somewhere.
TEST(ExactView, LeavesInteriorSurfacesThatPassThroughOneAnother) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  scene.add({"one way", parallelogram({0, 1, 0}, {2, 1, 0}, {0, 0, 2})});
  scene.add({"the other", parallelogram({0, 2, 0}, {2, -1, 0}, {0, 0, 2})});
  ExactQuestions ask(scene);
  EXPECT_FALSE(ask(sun_at(180, 10), 0, unlimited, {1, 2}));
  EXPECT_TRUE(ask(sun_at(180, 10), 0, unlimited, {1}));
}

TEST(ExactView, LeavesWhatWouldTakeLonger) {
  Scene const leaves = triangle_soup(400, 3);
  ExactQuestions ask(leaves);
  EXPECT_FALSE(ask(sun_at(180, 30), 0, 100.0));
  EXPECT_TRUE(ask(sun_at(180, 30), 0));
}

// Edges that lie on the receiver's sides, on one another, and on corners.
TEST(ExactView, OfEdgesInOnePlaceIsExact) {
  Scene scene;
  scene.add({"receiver", south_facing(0, 0, 0, 2, 2)});
  SunDirection const sun = sun_at(180, 1e-9);
  scene.add({"left half", south_facing(-1, -1, 0, 2, 2)});
  scene.add({"the same", south_facing(-1, -2, 0, 2, 2)});
  scene.add({"upper half of the rest", south_facing(1, -1, 1, 1, 1)});
  scene.add({"beside it", south_facing(2, -1, 0, 5, 2)});
  scene.add({"half of what is left", {{{1, -1, 0}, {2, -1, 1}, {1, -1, 1}}, {}}});
  ExactQuestions ask(scene);
  auto const sums = ask(sun, 0);
  ASSERT_TRUE(sums);
  EXPECT_NEAR(sums->front().unscheduled, 0.125, 1e-8);
}

// Where it is cut at the plane, the corner comes twice.
TEST(ExactView, OfACornerOnTheReceiversPlaneIsExact) {
  // Its shadow is the triangle of (0, 3), (0, 1) and (4, 1).
  Polygon const shade{{{0, 0, 3}, {0, -2, 3}, {4, -2, 3}}, {}};
  Polygon wall = south_facing(0, 0, 0, 4, 4);
  wall.holes.push_back(south_facing(1, 0, 1, 1, 1).outline);  // all in shadow
  Polygon const triangle{{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}}, {}};
  for (auto const& [receiver, lit] : {std::pair{wall, 12.0 / 15.0}, {triangle, 1.0 - 3.5 / 8.0}}) {
    Scene scene;
    scene.add({"receiver", receiver});
    scene.add({"shade", shade});
    ExactQuestions ask(scene);
    auto const sums = ask(sun_at(180, 45), 0);
    ASSERT_TRUE(sums);
    EXPECT_NEAR(sums->front().unscheduled, lit, 1e-12);
  }
}

// A ring whose parts overlap, by the odd-even rule as elsewhere.
TEST(ExactView, OfAStarThatCrossesItselfLeavesItsMiddleOpen) {
  Scene scene;
  scene.add({"receiver", south_facing(-2, 0, -2, 4, 4)});
  Ring star;
  for (int i = 0; i < 5; ++i) {
    double const turn = 2.0 * std::numbers::pi * (2 * i) / 5.0;
    star.emplace_back(std::sin(turn), -1.0, std::cos(turn));
  }
  scene.add({"star", {star, {}}});
  ExactQuestions ask(scene);
  auto const sums = ask(sun_at(180, 1e-9), 0);
  ASSERT_TRUE(sums);
  // Five points of the pentagram of radius 1 without its pentagon.
  double const inner = std::pow(std::numbers::phi, -2);
  double const tenth = 0.5 * inner * std::sin(std::numbers::pi / 5);
  double const pentagon = 2.5 * inner * inner * std::sin(0.4 * std::numbers::pi);
  EXPECT_NEAR(sums->front().unscheduled, 1.0 - (10 * tenth - pentagon) / 16.0, 1e-7);
}

}  // namespace
}  // namespace gpu_shading
