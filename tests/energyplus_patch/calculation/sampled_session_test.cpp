#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <regex>

#include "calculation/session.h"
#include "gpu_shading/sun_position.h"
#include "model/idf/model_file.h"
#include "platform/process.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

// Coarser than what is compared.
constexpr int resolution = 128;

// What a session said.
struct Said {
  std::vector<std::string> remarks;

  Messages messages() {
    return {[](std::string const&) {}, [this](std::string const& line) { remarks.push_back(line); },
            [](std::string const&) {}};
  }
};

Surface surface_of(std::string name, glm::dvec3 const& corner, glm::dvec3 const& a,
                   glm::dvec3 const& b) {
  Surface surface;
  surface.name = std::move(name);
  surface.polygon = {{corner, corner + a, corner + a + b, corner + b}, {}};
  return surface;
}

// A south wall under an overhang, and a floor; the sun of 42 degrees north.
struct Sampled {
  explicit Sampled(std::optional<Sampling> sampling = Sampling{Sampling::Density::coarse, false},
                   std::filesystem::path const& cache = {}, bool deployed = false)
      : session(model(sampling, cache, deployed)) {
    wall = session.add(surface_of("WALL", {0, 0, 0}, {3, 0, 0}, {0, 0, 3}));
    floor = session.add(surface_of("FLOOR", {0, -3, -1}, {3, 0, 0}, {0, 3, 0}));
    session.add(surface_of("PLATE", {0, -1, 3}, {3, 0, 0}, {0, 1, 0}));
    session.start({said.messages(),
                   {[](std::string const&) { return std::pair(0.0, 1.0); },
                    [this](std::string const&, Moment) { return share; }},
                   [] { return latitude; }});
  }

  static Model model(std::optional<Sampling> const& sampling, std::filesystem::path const& cache,
                     bool deployed) {
    auto const objects = read_idf(
        deployed ? "Shading:Site:Detailed,Plate;GPUShading:PerforatedScreen,S,Plate,Round,,,0.005,,"
                   "0.008,,0,,,,,,,,,,,Sails;"
                 : "Shading:Site:Detailed,Plate,Leaves;");
    Model made;
    made.shading = read_shading_input(objects);
    if (deployed) made.screens = read_perforated_screens(objects, made.shading, {}, {});
    made.options.update = {sampling.has_value(), sampling};
    made.options.resolution = resolution;
    if (!cache.empty()) made.options.cache = CacheFolder{cache};
    return made;
  }

  double at(SurfaceId receiver, double declination, double hour_angle) {
    session.set_time({12, 1});
    session.set_sun(
        to_direction(HourDirection{declination * degree, hour_angle * degree}, latitude));
    return session.projected_sunlit_area(receiver);
  }

  // Directions rendered, and what was said of the samples.
  std::pair<int, std::string> finish() {
    said.remarks.clear();  // of the start, such as that there is no GPU
    session.finish();
    std::smatch found;
    EXPECT_TRUE(std::regex_search(said.remarks[0], found, std::regex("(\\d+) directions")));
    return {std::stoi(found[1]), said.remarks.size() > 1 ? said.remarks[1] : ""};
  }

  static constexpr double degree = std::numbers::pi / 180.0;
  static constexpr double latitude = 42.0 * degree;
  Said said;
  double share = 0.5;
  Session session;
  SurfaceId wall = 0;
  SurfaceId floor = 0;
};

TEST(SampledSession, SamplesAnswerTheSunWithinTheirErrorAndFollowSchedules) {
  Sampled sampled;
  Sampled exact(std::nullopt);
  for (double const leaves : {0.5, 0.0, 1.0}) {
    sampled.share = exact.share = leaves;
    for (double const declination : {-20.0, 3.0, 17.0}) {
      for (int hour = -4; hour <= 4; ++hour) {
        for (auto const receiver : {exact.wall, exact.floor}) {
          double const whole = 9.0;
          EXPECT_NEAR(sampled.at(receiver, declination, 15.0 * hour + 2.0),
                      exact.at(receiver, declination, 15.0 * hour + 2.0), 0.02 * whole);
        }
      }
    }
  }
  auto const [rendered, remark] = sampled.finish();
  // Both receivers have the same samples: they are known before the first question.
  EXPECT_NE(remark.find("81 directions of the sun answered from samples at 238,"),
            std::string::npos)
      << remark;
  EXPECT_THAT(remark, testing::HasSubstr("; estimated mean error of the worst receiver's"));
  EXPECT_LE(rendered, 238);
  EXPECT_EQ(exact.finish().first, 27);
}

TEST(SampledSession, PatchesOfTheSkyAreRenderedWhateverTheSampling) {
  Sampled sampled;
  // 37.5 degrees above the horizon in the south the sun stands in October.
  sampled.session.set_time({});
  sampled.session.set_sun({std::numbers::pi, 37.5 * Sampled::degree});
  EXPECT_TRUE(is_sky_patch({std::numbers::pi, 37.5 * Sampled::degree}));
  sampled.session.projected_sunlit_area(sampled.wall);
  // Beyond the solstices the sun is never.
  sampled.session.set_sun({0.1, 0.3});
  sampled.session.projected_sunlit_area(sampled.floor);
  auto const [rendered, remark] = sampled.finish();
  EXPECT_EQ(rendered, 2);
  EXPECT_NE(remark.find("0 directions of the sun answered from samples at 0,"), std::string::npos);
}

TEST(SampledSession, SamplesAreKeptInTheCacheAsAnyDirection) {
  TemporaryFolder const folder;
  auto const run = [&](Sampling::Density density) {
    Sampled sampled(Sampling{density, false}, folder.path());
    double sum = 0.0;
    for (int hour = -3; hour <= 3; ++hour)
      sum += sampled.at(sampled.wall, -11.0, 15.0 * hour + 2.0);
    return std::pair(sum, sampled.finish().first);
  };
  auto const [first, rendered] = run(Sampling::Density::coarse);
  auto const [again, from_cache] = run(Sampling::Density::coarse);
  EXPECT_GE(rendered, 238);
  EXPECT_LE(rendered, 476);
  EXPECT_EQ(from_cache, 0);
  EXPECT_EQ(first, again);
  // What is interpolated is not kept as if it were rendered.
  EXPECT_GT(run(Sampling::Density::medium).second, 0);
}

TEST(SampledSession, EachStateOfDeploymentsHasItsOwnSamplesOnceItIsWorthThem) {
  Sampled sampled(Sampling{Sampling::Density::coarse, false}, {}, true);
  sampled.share = 1.0;
  auto const out = sampled.at(sampled.wall, 10.0, 5.0);
  // Few directions of another state are rendered.
  sampled.share = 0.0;
  for (int i = 0; i < 10; ++i) EXPECT_GT(sampled.at(sampled.wall, 10.0, i), out);
  auto const [rendered, remark] = sampled.finish();
  EXPECT_GE(rendered, 238 + 10);
  EXPECT_LE(rendered, 476 + 10);
  auto const samples = std::to_string(rendered - 10);
  EXPECT_THAT(remark, testing::HasSubstr("1 directions of the sun answered from samples at " +
                                         samples + ","));
  // With many directions, samples are taken.
  for (int i = 0; i < 476 + 20; ++i) sampled.at(sampled.wall, 10.0, -40.0 + 0.15 * i);
  sampled.session.finish();
  EXPECT_THAT(sampled.said.remarks.back(),
              testing::Not(testing::HasSubstr("answered from samples at " + samples + ",")));
}

TEST(SampledSession, InteriorsAreSampledAndGetNoMoreThanTheirWindow) {
  auto const run = [](std::optional<Sampling> sampling) {
    Model model;
    model.options.update = {sampling.has_value(), sampling};
    model.options.resolution = resolution;
    Session session(std::move(model));
    auto const skylight = session.add(surface_of("SKYLIGHT", {0, 0, 3}, {3, 0, 0}, {0, 2, 0}));
    std::vector<SurfaceId> room;
    for (double x : {-4.0, 0.0, 4.0}) {
      room.push_back(session.add(surface_of("FLOOR", {x, -9, 0}, {0, 20, 0}, {4, 0, 0})));
    }
    Said said;
    session.start({said.messages(), {}, [] { return Sampled::latitude; }});
    std::vector<std::vector<double>> all;
    for (int hour = -4; hour <= 4; ++hour) {
      session.set_time({12, 1});
      session.set_sun(to_direction(HourDirection{0.2, (15.0 * hour + 2.0) * Sampled::degree},
                                   Sampled::latitude));
      auto areas = session.interior_areas(skylight, room);
      areas.push_back(session.projected_sunlit_area(skylight));
      all.push_back(std::move(areas));
    }
    return all;
  };
  auto const exact = run(std::nullopt);
  auto const sampled = run(Sampling{Sampling::Density::medium, false});
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LE(sampled[i][0] + sampled[i][1] + sampled[i][2], sampled[i][3] * (1 + 1e-6));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sampled[i][k], exact[i][k], 0.02 * 6.0) << i;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
