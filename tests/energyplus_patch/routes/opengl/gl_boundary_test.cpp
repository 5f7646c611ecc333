// The calls of OpenGL that Penumbra makes, as its sources make them, and what is understood of
// them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calculation/plain_scene.h"
#include "routes/opengl/queries/named_surfaces.h"
#include "routes/opengl/queries/recorder.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using Triangles = std::vector<glm::vec3>;

constexpr float quarter_turn = 1.57079632F;

// A horizontal rectangle, seen from above.
Triangles rectangle(glm::vec3 const& corner, float width, float depth) {
  auto const a = corner;
  auto const b = corner + glm::vec3(width, 0, 0);
  auto const c = corner + glm::vec3(width, depth, 0);
  auto const d = corner + glm::vec3(0, depth, 0);
  return {a, b, c, a, c, d};
}

Triangles joined(std::vector<Triangles> const& parts) {
  Triangles all;
  for (auto const& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Does what Penumbra::Context does, in single precision.
class Penumbra {
 public:
  Penumbra(std::vector<Triangles> const& surfaces, int size, Recorder& recorder)
      : size_(size), recorder_(recorder) {
    ranges_.reserve(surfaces.size());
    for (auto const& surface : surfaces) {
      ranges_.push_back({static_cast<std::uint32_t>(vertices_.size()),
                         static_cast<std::uint32_t>(surface.size())});
      vertices_.insert(vertices_.end(), surface.begin(), surface.end());
    }
    recorder_.set_viewport(size, size);
    if (!vertices_.empty()) {
      recorder_.set_vertices({&vertices_[0].x, vertices_.size() * 3});
    }
    queries_.resize(surfaces.size());
    recorder_.create_queries(queries_);
    areas_.resize(surfaces.size());
  }

  void set_sun(float azimuth, float altitude) {
    glm::vec3 const eye(std::cos(altitude) * std::sin(azimuth),
                        std::cos(altitude) * std::cos(azimuth), std::sin(altitude));
    view_ = glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 0, 1));
  }

  void submit() {
    for (std::size_t i = 0; i < ranges_.size(); ++i) submit(i);
  }

  void submit(std::size_t surface) {
    areas_[surface] = set_scene(surface);
    recorder_.clear();
    recorder_.draw({0, static_cast<std::uint32_t>(vertices_.size())});
    count(queries_[surface], surface);
  }

  float retrieve(std::size_t surface) {
    return static_cast<float>(recorder_.result(queries_[surface])) * areas_[surface];
  }

  std::vector<float> interiors(std::size_t window, std::vector<std::size_t> const& surfaces) {
    std::vector<Recorder::Query> queries(surfaces.size());
    recorder_.create_queries(queries);
    float const area = set_scene(window);
    recorder_.clear();
    auto const hidden = ranges_[window];
    auto const all = static_cast<std::uint32_t>(vertices_.size());
    if (hidden.first > 0) recorder_.draw({0, hidden.first});
    if (hidden.end() < all) recorder_.draw({hidden.end(), all - hidden.end()});
    for (std::size_t i = 0; i < surfaces.size(); ++i) count(queries[i], surfaces[i]);
    std::vector<float> answers;
    answers.reserve(queries.size());
    for (auto const query : queries) {
      answers.push_back(static_cast<float>(recorder_.result(query)) * area);
    }
    recorder_.delete_queries(queries);
    return answers;
  }

 private:
  float set_scene(std::size_t surface) {
    auto const inverse = 1.0F / static_cast<float>(size_);
    glm::vec2 low(std::numeric_limits<float>::max());
    glm::vec2 high = -low;
    for (auto i = ranges_[surface].first; i < ranges_[surface].end(); ++i) {
      auto const seen = glm::vec2(view_ * glm::vec4(vertices_[i], 0));
      low = glm::min(low, seen);
      high = glm::max(high, seen);
    }
    auto const border = (high - low) * inverse;
    low -= border;
    high += border;
    float const area = (high.x - low.x) * (high.y - low.y) * inverse * inverse;
    if (area > 0.0F && std::isfinite(area)) {
      auto const matrix = glm::ortho(low.x, high.x, low.y, high.y, -90.0F, 110.0F) * view_;
      std::array<float, 16> values{};
      std::copy_n(&matrix[0][0], values.size(), values.begin());
      recorder_.set_matrix(values);
    }
    return area;
  }

  void count(Recorder::Query query, std::size_t surface) {
    recorder_.begin_query(query);
    recorder_.draw(ranges_[surface]);
    recorder_.end_query();
  }

  int size_;
  Recorder& recorder_;
  Triangles vertices_;
  std::vector<DrawnRange> ranges_;
  std::vector<Recorder::Query> queries_;
  std::vector<float> areas_;
  glm::mat4 view_{1.0F};
};

// Takes down what it is asked.
struct Asked {
  std::vector<std::size_t> corners;  // of the surfaces
  std::vector<glm::dvec3> suns;
  std::vector<SurfaceId> receivers;
};

class FixedAnswers : public ShadingCalculation {
 public:
  explicit FixedAnswers(Asked& asked) : asked_(asked) { asked_.corners.clear(); }

  SurfaceId add(Surface surface) override {
    asked_.corners.push_back(surface.polygon.outline.size());
    return static_cast<SurfaceId>(size() - 1);
  }
  std::size_t size() const override { return asked_.corners.size(); }
  bool wants_mirrored() const override { return false; }
  SurfaceId add_mirrored(SurfaceId original) override { return original; }
  void start(Simulation /*simulation*/) override {}
  void set_time(Moment /*moment*/) override {}
  void set_sun(SunDirection sun) override { asked_.suns.push_back(to_vector(sun)); }
  double projected_sunlit_area(SurfaceId receiver) override {
    asked_.receivers.push_back(receiver);
    return 0.25;
  }
  std::vector<double> projected_sunlit_areas(std::span<SurfaceId const> receivers) override {
    std::vector<double> areas;
    for (auto const receiver : receivers) areas.push_back(projected_sunlit_area(receiver));
    return areas;
  }
  std::vector<double> interior_areas(SurfaceId window,
                                     std::vector<SurfaceId> const& interiors) override {
    asked_.receivers.push_back(window);
    asked_.receivers.insert(asked_.receivers.end(), interiors.begin(), interiors.end());
    return std::vector<double>(interiors.size(), 0.125);
  }
  double daylight_transmittance(Ray const& /*ray*/, int /*hour*/) override { return 1.0; }
  void begin_daylighting() override {}
  std::string vendor() override { return {}; }
  void fail() override {}
  void finish() override {}

 private:
  Asked& asked_;
};

std::shared_ptr<DrawnModel> fixed_model(Asked& asked) {
  return std::make_shared<DrawnModel>([&] { return std::make_unique<FixedAnswers>(asked); });
}

std::shared_ptr<DrawnModel> plain_model() {
  RendererOptions options;
  options.device.device = DeviceId{};
  return std::make_shared<DrawnModel>([options] { return std::make_unique<PlainScene>(options); });
}

TEST(TrianglePolygons, OutlineAndHoleOfAFrame) {
  // Between the squares of 3 m and of 1 m, both about (1.5, 1.5).
  std::vector<glm::vec3> const outer{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
  std::vector<glm::vec3> const inner{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  Triangles frame;
  for (std::size_t i = 0; i < 4; ++i) {
    auto const next = (i + 1) % 4;
    frame.insert(frame.end(),
                 {outer[i], outer[next], inner[next], outer[i], inner[next], inner[i]});
  }
  auto const polygons = polygons_of(frame);
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_EQ(polygons[0].outline.size(), 4U);
  ASSERT_EQ(polygons[0].holes.size(), 1U);
  EXPECT_DOUBLE_EQ(area(polygons[0]), 8.0);
  EXPECT_EQ(normal(polygons[0]), glm::dvec3(0, 0, 1));
}

TEST(TrianglePolygons, SeparatePartsAreSeparate) {
  auto const polygons =
      polygons_of(joined({rectangle({0, 0, 0}, 1, 1), rectangle({5, 0, 0}, 2, 1)}));
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_DOUBLE_EQ(area(polygons[0]) + area(polygons[1]), 3.0);
}

TEST(TrianglePolygons, PartsThatTouchInAVertexKeepTheirArea) {
  auto const polygons =
      polygons_of(joined({rectangle({0, 0, 0}, 1, 1), rectangle({1, 1, 0}, 2, 1)}));
  double sum = 0.0;
  for (auto const& polygon : polygons) sum += area(polygon);
  EXPECT_DOUBLE_EQ(sum, 3.0);
}

Surface named(std::string name, Ring outline, std::vector<Ring> holes = {}) {
  return {.name = std::move(name), .polygon = {std::move(outline), std::move(holes)}};
}

Ring ring_of(glm::dvec3 const& corner, double width, double depth) {
  return {corner, corner + glm::dvec3(width, 0, 0), corner + glm::dvec3(width, depth, 0),
          corner + glm::dvec3(0, depth, 0)};
}

// Names in the order in which two rectangles are drawn.
std::vector<std::string> names_of(Triangles const& first, Triangles const& second,
                                  std::vector<Surface> const& list) {
  auto const vertices = joined({first, second});
  std::vector<DrawnRange> const ranges{{0, 6}, {6, 6}};
  std::vector<std::string> names;
  for (auto const& surface : name_surfaces(vertices, ranges, list)) names.push_back(surface.name);
  return names;
}

TEST(NamedSurfaces, AreFoundByTheirVerticesInAnyOrder) {
  auto const small = rectangle({0, 0, 0}, 1, 1);
  auto const large = rectangle({0, 0, 0}, 2, 1);
  std::vector<Surface> const list{named("LARGE", ring_of({0, 0, 0}, 2.00001, 1)),
                                  named("SMALL", ring_of({0, 0, 0}, 1, 0.99999))};
  EXPECT_THAT(names_of(small, large, list), ElementsAre("SMALL", "LARGE"));
  EXPECT_THAT(names_of(large, small, list), ElementsAre("LARGE", "SMALL"));
}

TEST(NamedSurfaces, InOnePlaceAreTakenInOrder) {
  auto const drawn = rectangle({0, 0, 0}, 1, 1);
  std::vector<Surface> const list{named("FIRST", ring_of({0, 0, 0}, 1, 1)),
                                  named("SECOND", ring_of({0, 0, 0}, 1, 1))};
  EXPECT_THAT(names_of(drawn, drawn, list), ElementsAre("FIRST", "SECOND"));
}

TEST(NamedSurfaces, KeepTheVerticesThatAreDrawn) {
  auto const drawn = rectangle({0, 0, 0}, 1.000004F, 1);
  std::vector<DrawnRange> const ranges{{0, 6}};
  auto const found = name_surfaces(drawn, ranges, {named("ONLY", ring_of({0, 0, 0}, 1.0, 1))});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].polygon.outline[1].x, double{1.000004F});
}

TEST(NamedSurfaces, OneThatIsNotListedIsRefused) {
  auto const one = rectangle({0, 0, 0}, 1, 1);
  auto const turned = Triangles{one[2], one[1], one[0], one[5], one[4], one[3]};
  std::vector<Surface> const list{named("ONE", ring_of({0, 0, 0}, 1, 1)),
                                  named("TWO", ring_of({0, 0, 0}, 1, 1))};
  EXPECT_EQ(refusal_of([&] { names_of(one, turned, list); }),
            "EnergyPlus draws a surface at (1.000, 1.000, 0.000) that is none of those in its list "
            "of surfaces");
}

TEST(Recorder, ReadsDirectionsFromMatrices) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1)}, 512, recorder);
  for (float const azimuth : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}) {
    for (float const altitude : {0.01F, 0.5F, 1.0F, 1.5F}) {
      penumbra.set_sun(azimuth, altitude);
      penumbra.submit();
      penumbra.retrieve(0);
      auto const expected = to_vector({azimuth, altitude});
      EXPECT_LT(glm::distance(asked.suns.back(), expected), 1e-6) << azimuth << ' ' << altitude;
    }
  }
}

TEST(Recorder, AnswersWithAreaOfPixels) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1)}, 512, recorder);
  penumbra.set_sun(2.0F, 0.7F);
  penumbra.submit();
  // Of a bounding rectangle of up to 2 m2, half a pixel of 512 x 512.
  EXPECT_NEAR(penumbra.retrieve(0), 0.25, 4e-6);
}

TEST(Recorder, SurfacesOfOneSunHaveOneDirection) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1), rectangle({40, 30, 7}, 3, 0.1F),
                     rectangle({-20, 9, 1}, 0.01F, 20)},
                    512, recorder);
  penumbra.set_sun(2.0F, 0.7F);
  penumbra.submit();
  for (std::size_t i = 0; i < 3; ++i) penumbra.retrieve(i);
  EXPECT_EQ(asked.suns.size(), 1U);
  EXPECT_THAT(asked.receivers, ElementsAre(0, 1, 2));
}

// EnergyPlus passes internal mass as an empty polygon.
TEST(Recorder, SurfacesWithoutVerticesAreNotAskedAbout) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1), {}, {}, rectangle({2, 0, 0}, 1, 1)}, 512,
                    recorder);
  penumbra.set_sun(2.0F, 0.7F);
  penumbra.submit();
  for (std::size_t i = 0; i < 4; ++i) penumbra.retrieve(i);
  EXPECT_THAT(asked.receivers, ElementsAre(0, 1));
  EXPECT_THAT(asked.corners, ElementsAre(4, 4));
}

// What no query has drawn may cast shadows all the same.
TEST(Recorder, UnknownSurfacesAreTakenByTriangle) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1), rectangle({2, 0, 0}, 1, 1)}, 512, recorder);
  penumbra.set_sun(2.0F, 0.7F);
  penumbra.submit(1);
  penumbra.retrieve(1);
  EXPECT_THAT(asked.corners, ElementsAre(3, 3, 4));
  penumbra.submit(0);
  penumbra.retrieve(0);
  EXPECT_THAT(asked.corners, ElementsAre(4, 4));
}

TEST(Recorder, FindsTheWindowOfInteriorQuestions) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra({rectangle({0, 0, 0}, 9, 9), rectangle({1, 1, 3}, 1, 1),
                     rectangle({0, 0, 1}, 2, 2), rectangle({3, 3, 1}, 2, 2)},
                    512, recorder);
  penumbra.set_sun(2.0F, 0.7F);
  penumbra.submit();
  penumbra.retrieve(0);
  asked.receivers.clear();
  auto const areas = penumbra.interiors(1, {0, 2, 3});
  EXPECT_THAT(asked.receivers, ElementsAre(1, 0, 2, 3));
  for (auto const area : areas) EXPECT_NEAR(area, 0.125, 4e-6);
}

TEST(Recorder, RefusesAQueryThatWasNotMade) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  EXPECT_EQ(refusal_of([&] { recorder.result(7); }),
            "EnergyPlus asks for a query that it did not make");
}

// A square of 1 m under one that covers its southern half as the sun stands at the zenith.
TEST(PlainScene, HalfCoveredSquare) {
  Recorder recorder(plain_model());
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1), rectangle({-1, -0.5F, 2}, 3, 1)}, 512, recorder);
  penumbra.set_sun(0.0F, quarter_turn - 1e-4F);
  penumbra.submit();
  EXPECT_NEAR(penumbra.retrieve(0), 0.5, 5e-4);
  EXPECT_NEAR(penumbra.retrieve(1), 3.0, 1e-4);
  // From the north at 45 degrees the shadow falls 2 m southwards, past the square.
  penumbra.set_sun(0.0F, quarter_turn / 2);
  penumbra.submit();
  EXPECT_NEAR(penumbra.retrieve(0), std::sqrt(0.5), 1e-4);
}

// As OpenGL draws them: whichever way the triangles turn.
TEST(PlainScene, SurfacesHaveTwoSides) {
  Recorder recorder(plain_model());
  Penumbra penumbra({rectangle({0, 0, 0}, 1, 1), rectangle({-1, -0.5F, -2}, 3, 1)}, 512, recorder);
  penumbra.set_sun(0.0F, -quarter_turn + 1e-4F);
  penumbra.submit();
  EXPECT_NEAR(penumbra.retrieve(0), 0.5, 5e-4);
  EXPECT_NEAR(penumbra.retrieve(1), 3.0, 1e-4);
}

TEST(Recorder, KnowsAWindowThatWasNotAskedAbout) {
  Asked asked;
  Recorder recorder(fixed_model(asked));
  Penumbra penumbra(
      {rectangle({0, 0, 0}, 2, 4), rectangle({1.5F, 1, 3}, 1, 1), rectangle({2, 0, 0}, 2, 4)}, 512,
      recorder);
  penumbra.set_sun(0.0F, 1.0F);
  auto const interiors = penumbra.interiors(1, {0, 2});
  EXPECT_NEAR(interiors[1], 0.125, 1e-5);
  EXPECT_THAT(asked.corners, ElementsAre(4, 4, 4));
}

TEST(PlainScene, FloorBehindASkylight) {
  Recorder recorder(plain_model());
  Penumbra penumbra(
      {rectangle({0, 0, 0}, 2, 4), rectangle({2, 0, 0}, 2, 4), rectangle({1.5F, 1, 3}, 1, 1)}, 1024,
      recorder);
  penumbra.set_sun(0.0F, quarter_turn - 1e-4F);
  penumbra.submit();
  penumbra.retrieve(2);
  auto const areas = penumbra.interiors(2, {0, 1});
  EXPECT_NEAR(areas[0], 0.5, 2e-3);
  EXPECT_NEAR(areas[1], 0.5, 2e-3);
}

}  // namespace
}  // namespace gpu_shading::energyplus
