// Shades that let the sun through, against exact overlays of polygons.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "each_backend.h"
#include "gpu_shading/error.h"
#include "gpu_shading/image.h"
#include "gpu_shading/transmittance.h"
#include "support/exact.h"
#include "support/gl_renderer.h"
#include "support/pixels_on_cpu.h"
#include "support/random_scene.h"
#include "support/room.h"
#include "support/transparent_case.h"

namespace gpu_shading {
namespace {

std::shared_ptr<Transmittance const> constant(double value) {
  return std::make_shared<Transmittance const>(Transmittance::constant(value));
}

// Single glazing: 0.8 at normal incidence, 0 at grazing.
std::shared_ptr<Transmittance const> glass() {
  return std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
}

Renderer renderer_by(Scene scene, LuminanceSum sum, int resolution = 512) {
  return gl_renderer(std::move(scene), resolution, {.sum = sum});
}

class Luminance : public EachBackend {};
class Schedules : public EachBackend {
 protected:
  // Where both back ends sample scheduled shades.
  static Renderer renderer_at_pixels(Scene scene, int resolution = 512) {
    if (GetParam() == on_cpu) return counting_pixels(std::move(scene), resolution);
    return renderer_of(std::move(scene), resolution);
  }
};
INSTANTIATE_TEST_SUITE_P(Is, Luminance, backends, name_of);
INSTANTIATE_TEST_SUITE_P(Are, Schedules, backends, name_of);

TEST_P(Luminance, TransparentCaseOfJonesAndGreenberg) {
  std::vector<SunDirection> suns = year_of_suns(42 * degree);
  std::printf("%zu positions\n", suns.size());
  std::mt19937 engine(20240621);
  constexpr std::size_t drawn = 2000;
  for (std::size_t i = 0; i < drawn; ++i) {
    std::swap(suns[i], suns[i + engine() % (suns.size() - i)]);
  }
  suns.resize(drawn);

  Scene const scene = transparent_case();
  Renderer renderer = renderer_of(scene);
  double signed_mean = 0.0;
  double mean = 0.0;
  double most = 0.0;
  for (SunDirection const sun : suns) {
    double const exact = exact::projected_sunlit_area(scene, sun, 0);
    // The overlay against its closed form; polyclipping rounds to 10 nm.
    ASSERT_NEAR(exact, transparent_case_pssf(sun), 1e-7);
    double const error = sunlit(renderer, sun, 0).projected_area - exact;
    signed_mean += error / drawn;
    mean += std::abs(error) / drawn;
    most = std::max(most, std::abs(error));
  }
  std::printf("PSSF error: signed mean %+.2e, mean %.2e, most %.2e\n", signed_mean, mean, most);
  EXPECT_LT(std::abs(signed_mean), 2e-6);
  EXPECT_LE(mean, 1e-5);
  EXPECT_LE(most, 5e-4);
  EXPECT_GT(renderer.statistics().luminance_views, drawn * 9 / 10);
}

// All the receiver under every shade: no edges, so that only the product counts.
TEST_P(Luminance, OverlappingShadesMultiply) {
  std::vector<double> const taus{0.9, 0.62, 0.35, 0.77, 0.81};
  for (std::size_t const stacked : {2U, 5U}) {
    Scene scene;
    scene.add({"receiver", level(0, 0, 0, 1, 1)});
    double product = 1.0;
    for (std::size_t i = 0; i < stacked; ++i) {
      scene.add({"shade",
                 level(-5, -5, 0.3 + 0.1 * static_cast<double>(i), 11, 11),
                 Casting::always,
                 {{AngularTransmittance{constant(taus[i])}}}});
      product *= taus[i];
    }
    Renderer renderer = renderer_of(scene);
    EXPECT_NEAR(sunlit(renderer, {}, 0).projected_area, product, 2e-7);
  }
}

// Shades that overlap in part, each with edges over the receiver.
Scene stack(std::size_t shades) {
  std::vector<double> const taus{0.9, 0.62, 0.35, 0.77, 0.81};
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  for (std::size_t i = 0; i < shades; ++i) {
    auto const n = static_cast<double>(i);
    double const turn = 0.3 + 0.7 * n;
    glm::dvec3 const a(0.8 * std::cos(turn), 0.8 * std::sin(turn), 0.05 * n);
    glm::dvec3 const b(-0.7 * std::sin(turn), 0.7 * std::cos(turn), 0.1);
    glm::dvec3 const centre(0.4 + 0.05 * n, 0.5 - 0.04 * n, 0.2 + 0.07 * n);
    scene.add({"shade",
               parallelogram(centre - 0.5 * (a + b), a, b),
               Casting::always,
               {{AngularTransmittance{i % 2 == 0 ? constant(taus[i]) : glass()}}}});
  }
  return scene;
}

std::vector<SunDirection> const around{sun_at(10, 60),  sun_at(75, 50),  sun_at(180, 65),
                                       sun_at(230, 45), sun_at(300, 75), {}};

TEST_P(Luminance, StacksOfTwoAndFiveAgainstExactOverlay) {
  for (std::size_t const shades : {2U, 5U}) {
    Scene const scene = stack(shades);
    Renderer renderer = renderer_of(scene, 2048);
    for (SunDirection const sun : around) {
      double const exact = exact::projected_sunlit_area(scene, sun, 0);
      EXPECT_LT(exact, 0.9 * std::sin(sun.altitude));
      EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, exact, 1e-4) << shades;
    }
  }
}

TEST_P(Luminance, TheOrderOfShadesDoesNotMatter) {
  Scene const scene = stack(5);
  Scene backwards;
  backwards.add(scene[0]);
  for (SurfaceId id = 5; id > 0; --id) backwards.add(scene[id]);
  Renderer renderer = renderer_of(scene);
  Renderer reversed = renderer_of(backwards);
  for (SunDirection const sun : around) {
    EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, sunlit(reversed, sun, 0).projected_area,
                1e-7);
  }
}

TEST_P(Luminance, BothFacesTransmitAlike) {
  Scene up;
  up.add({"receiver", level(0, 0, 0, 1, 1)});
  up.add({"shade", level(0, 0, 0.3, 1, 1), Casting::always, {{AngularTransmittance{glass()}}}});
  Scene down;
  down.add(up[0]);
  Surface turned = up[1];
  std::reverse(turned.polygon.outline.begin(), turned.polygon.outline.end());
  down.add(turned);
  Renderer one = renderer_of(up);
  Renderer other = renderer_of(down);
  SunDirection const sun = sun_at(200, 50);
  EXPECT_NEAR(sunlit(one, sun, 0).projected_area, sunlit(other, sun, 0).projected_area, 1e-7);
}

TEST_P(Luminance, OpaqueAndTransparentTogether) {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      if (id % 3 == 1) surface.filter.set(AngularTransmittance{glass()});
      if (id % 3 == 2) surface.filter.set(AngularTransmittance{constant(0.1 * id)});
      scene.add(surface);
    }
    Renderer renderer = renderer_of(scene);
    EXPECT_NEAR(sunlit(renderer, random.sun, 0).projected_area,
                exact::projected_sunlit_area(scene, random.sun, 0), 4e-3 * area(scene[0].polygon))
        << seed;
  }
}

// The luminance of what lets nothing through against the count of what is opaque.
TEST(Luminance, OfOpaqueShadesIsTheirCount) {
  for (DeviceChoice const how : {by_opengl, on_cpu}) {
    std::size_t views = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
      RandomScene const random = random_scene(seed);
      Scene scene;
      for (SurfaceId id = 0; id < random.scene.size(); ++id) {
        Surface surface = random.scene[id];
        surface.filter.set(AngularTransmittance{constant(0.0)});
        scene.add(surface);
      }
      Renderer counting = renderer_of(random.scene, 512, how);
      Renderer summing = renderer_of(scene, 512, how);
      Sunlit const counted = sunlit(counting, random.sun, 0);
      Sunlit const summed = sunlit(summing, random.sun, 0);
      // The CPU samples opaque views finely, so that it is the error of pixels there.
      double const within = how == on_cpu ? 5e-4 * area(scene[0].polygon) : 1e-6;
      EXPECT_NEAR(summed.projected_area, counted.projected_area, within) << seed;
      EXPECT_EQ(counting.statistics().luminance_views, 0U);
      views += summing.statistics().luminance_views;
    }
    EXPECT_GT(views, 80U);
  }
}

// What lets half of the beam through, over and over: by OpenGL and on the CPU.
TEST(Luminance, CountedIsAsDrawn) {
  double worst = 0.0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      if (id % 3 != 0) surface.filter.set(AngularTransmittance{constant(0.5)});
      scene.add(surface);
    }
    Renderer drawing = renderer_of(scene, 512, by_opengl);
    Renderer counting = counting_pixels(scene, 512);
    double const whole = area(scene[0].polygon);
    double const difference = sunlit(drawing, random.sun, 0).projected_area -
                              sunlit(counting, random.sun, 0).projected_area;
    EXPECT_NEAR(difference / whole, 0.0, 2e-4) << seed;
    worst = std::max(worst, std::abs(difference) / whole);
    EXPECT_EQ(counting.statistics().luminance_views, drawing.statistics().luminance_views);
  }
  EXPECT_GT(worst, 0.0);  // they are two
}

// On the samples of the CPU's own.
TEST(Luminance, CountedIsNearlyExact) {
  double worst = 0.0;
  double mean = 0.0;
  constexpr std::uint32_t scenes = 100;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      if (id % 3 != 0) surface.filter.set(AngularTransmittance{constant(id % 3 == 1 ? 0.5 : 0.8)});
      scene.add(surface);
    }
    Renderer counting = renderer_of(scene, 512, on_cpu);
    double const exact = exact::projected_sunlit_area(scene, random.sun, 0);
    double const error = std::abs(sunlit(counting, random.sun, 0).projected_area - exact) /
                         exact::projected_area(scene, random.sun, 0);
    worst = std::max(worst, error);
    mean += error / scenes;
  }
  std::printf("counted is off by %.1e in the mean, %.1e at most\n", mean, worst);
  EXPECT_LT(worst, 4e-4);
  EXPECT_LT(mean, 4e-5);
}

TEST(Luminance, SumsAgreeWhateverTheSide) {
  Scene const scene = stack(5);
  for (int const resolution : {512, 500, 192, 100, 65}) {
    Renderer compute = renderer_by(scene, LuminanceSum::compute, resolution);
    Renderer readback = renderer_by(scene, LuminanceSum::readback, resolution);
    for (SunDirection const sun : around) {
      double const area = sunlit(readback, sun, 0).projected_area;
      EXPECT_NEAR(sunlit(compute, sun, 0).projected_area, area, 2e-7) << resolution;
    }
  }
}

// More receivers than layers, some behind shades, some behind walls, some clear.
TEST(Luminance, ManyReceiversInOneCall) {
  Scene scene;
  std::vector<SurfaceId> receivers;
  for (int i = 0; i < 120; ++i) {
    double const x = 3.0 * i;
    receivers.push_back(scene.add({"receiver", level(x, 0, 0, 1, 1)}));
    Surface canopy{"canopy", level(x + 0.1 + 0.004 * i, 0.2, 0.5, 1, 1)};
    if (i % 4 == 1) canopy.filter.set(AngularTransmittance{glass()});
    if (i % 4 == 2) canopy.filter.schedule = i % 5;
    if (i % 4 != 3) scene.add(canopy);
  }
  for (LuminanceSum const how : {LuminanceSum::compute, LuminanceSum::readback}) {
    Renderer renderer = renderer_by(scene, how, 1024);
    std::vector<double> const factors{0.1, 0.2, 0.3, 0.4, 0.5};
    for (SunDirection const sun : {sun_at(180, 60), sun_at(120, 70)}) {
      auto const answers = renderer.projected_sunlit_areas(sun, receivers);
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        EXPECT_NEAR(answers[i].at(factors),
                    exact::projected_sunlit_area(scene, sun, receivers[i], factors), 1e-3)
            << i;
      }
      EXPECT_EQ(answers[1].projected_area, sunlit(renderer, sun, receivers[1]).projected_area);
      EXPECT_EQ(answers[2].at(factors), sunlit(renderer, sun, receivers[2]).at(factors));
    }
    EXPECT_EQ(renderer.statistics().luminance_views, 2U * 60U + 4U);
  }
}

TEST_P(Luminance, TheSameTwiceToTheBit) {
  Scene const scene = stack(5);
  Renderer one = renderer_of(scene);
  Renderer other = renderer_of(scene);
  for (SunDirection const sun : around) {
    EXPECT_EQ(sunlit(one, sun, 0).projected_area, sunlit(other, sun, 0).projected_area);
  }
}

TEST_P(Luminance, ThinRingOfWallUnderAGlassOverhang) {
  Polygon wall = south_facing(0, 0, 0, 3, 3);
  wall.holes = {south_facing(0.00025, 0, 0.00025, 2.9995, 2.9995).outline};
  Scene scene;
  scene.add({"wall", wall});
  scene.add({"overhang",
             level(0.7, -0.8, 3, 1.9, 0.8),
             Casting::always,
             {{AngularTransmittance{glass()}}}});
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(170, 45);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area / exact::projected_area(scene, sun, 0),
              exact::projected_sunlit_area(scene, sun, 0) / exact::projected_area(scene, sun, 0),
              2e-3);
}

// A barrel vault of panes over a terrace, some opaque.
Scene canopy(int panes_around, int panes_along) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 8, 12)});
  auto const rib = [&](int i, double y) {
    double const turn = (0.1 + 0.8 * i / panes_around) * std::numbers::pi;
    return glm::dvec3(4 - 5 * std::cos(turn), y, 1 + 4 * std::sin(turn));
  };
  for (int along = 0; along < panes_along; ++along) {
    double const y = 12.0 * along / panes_along;
    glm::dvec3 const depth(0, 12.0 / panes_along, 0);
    for (int i = 0; i < panes_around; ++i) {
      Surface pane{"pane", parallelogram(rib(i, y), rib(i + 1, y) - rib(i, y), depth)};
      if ((i + along) % 7 != 0) pane.filter.set(AngularTransmittance{glass()});
      scene.add(pane);
    }
  }
  return scene;
}

TEST_P(Luminance, CurvedCanopyOfManyPanes) {
  Scene const scene = canopy(12, 8);
  Renderer renderer = renderer_of(scene);
  for (SunDirection const sun : {sun_at(180, 60), sun_at(120, 35), sun_at(260, 20)}) {
    double const whole = exact::projected_area(scene, sun, 0);
    EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area / whole,
                exact::projected_sunlit_area(scene, sun, 0) / whole, 5e-4);
  }
}

Scene with_schedules(Scene const& scene, std::vector<int> const& schedules) {
  Scene scheduled;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface surface = scene[id];
    if (id > 0) surface.filter.schedule = schedules[(id - 1) % schedules.size()];
    scheduled.add(surface);
  }
  return scheduled;
}

// Surfaces that have only a schedule get its factor as a constant.
Scene at_factors(Scene const& scene, std::vector<double> const& factors) {
  Scene fixed;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface surface = scene[id];
    if (surface.filter.schedule >= 0) {
      surface.filter.set(AngularTransmittance{
          constant(factors[static_cast<std::size_t>(surface.filter.schedule)])});
      surface.filter.schedule = -1;
    }
    fixed.add(surface);
  }
  return fixed;
}

TEST_P(Schedules, ChangedFactorsAgainstAFreshRender) {
  Scene plain;
  Scene const five = stack(5);
  for (SurfaceId id = 0; id < five.size(); ++id) plain.add({five[id].name, five[id].polygon});
  Scene const scheduled = with_schedules(plain, {4, 7, 4, -1, 0});
  Renderer renderer = renderer_of(scheduled);
  for (SunDirection const sun : around) {
    Sunlit const kept = sunlit(renderer, sun, 0);
    for (std::vector<double> const& factors :
         {std::vector<double>{0.3, 9, 9, 9, 0.5, 9, 9, 0.8},
          std::vector<double>{1.0, 9, 9, 9, 1.0, 9, 9, 1.0},
          std::vector<double>{0.0, 9, 9, 9, 0.25, 9, 9, 0.0}}) {
      Renderer fresh = renderer_at_pixels(at_factors(scheduled, factors));
      EXPECT_NEAR(kept.at(factors), sunlit(fresh, sun, 0).projected_area, 1e-6);
    }
  }
}

TEST_P(Schedules, MultiplyWithTransmittancesOfTheSameSurfaces) {
  Scene const scene = with_schedules(stack(5), {0, 1, 0, 2, 1});
  Renderer renderer = renderer_of(scene, 1024);
  for (SunDirection const sun : around) {
    Sunlit const kept = sunlit(renderer, sun, 0);
    for (std::vector<double> const& factors :
         {std::vector<double>{1, 1, 1}, std::vector<double>{0.5, 0.7, 0.2}}) {
      EXPECT_NEAR(kept.at(factors), exact::projected_sunlit_area(scene, sun, 0, factors), 3e-4);
    }
  }
  // With every factor 1 it is the view of the same shades without schedules.
  Renderer unscheduled = renderer_at_pixels(stack(5), 1024);
  for (SunDirection const sun : around) {
    EXPECT_NEAR(sunlit(renderer, sun, 0).at(std::vector<double>{1, 1, 1}),
                sunlit(unscheduled, sun, 0).projected_area, 1e-6);
  }
}

TEST_P(Schedules, PartsNameEachCombinationOnce) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  auto const shade = [&](double x, double z, int schedule) {
    scene.add({"shade", level(x, -1, z, 3, 3), Casting::always, {{}, schedule}});
  };
  shade(0.5, 0.1, 3);
  shade(0.75, 0.2, 3);
  shade(0.75, 0.3, 1);
  Renderer renderer = renderer_of(scene);
  Sunlit const answer = sunlit(renderer, {}, 0);
  EXPECT_NEAR(answer.projected_area, 0.5, 1e-3);
  ASSERT_EQ(answer.scheduled.size(), 2U);
  for (ScheduledPart const& part : answer.scheduled) EXPECT_NEAR(part.projected_area, 0.25, 1e-3);
  using Powers = std::vector<std::pair<int, int>>;
  std::vector<Powers> found{answer.scheduled[0].powers, answer.scheduled[1].powers};
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<Powers>{{{1, 1}, {3, 2}}, {{3, 1}}}));
  EXPECT_NEAR(answer.at(std::vector<double>{0, 0.5, 0, 0.2}), 0.5 + 0.25 * 0.2 + 0.25 * 0.02, 1e-3);
  EXPECT_THROW(answer.at(std::vector<double>{0, 0.5}), Error);
}

// Sixty sheets on one schedule, and as many schedules as fit.
TEST_P(Schedules, ManyShadesOfOneAndManyOfTheirOwn) {
  for (bool const shared : {true, false}) {
    Scene scene;
    scene.add({"receiver", level(0, 0, 0, 1, 1)});
    constexpr int sheets = 60;
    for (int i = 0; i < sheets; ++i) {
      scene.add(
          {"sheet", level(-1, -1, 0.1 + 0.01 * i, 3, 3), Casting::always, {{}, shared ? 0 : i}});
    }
    Renderer renderer = renderer_of(scene, 64);
    Sunlit const answer = sunlit(renderer, {}, 0);
    ASSERT_EQ(answer.scheduled.size(), 1U);
    EXPECT_NEAR(answer.at(std::vector<double>(sheets, 0.97)), std::pow(0.97, sheets), 1e-9);
  }
}

TEST(Schedules, TooManyToTellApartIsAnErrorThatNamesTheReceiver) {
  Scene scene;
  scene.add({"the terrace", level(0, 0, 0, 1, 1)});
  for (int i = 0; i < 73; ++i) {
    scene.add({"sheet", level(-1, -1, 0.1 + 0.01 * i, 3, 3), Casting::always, {{}, i}});
  }
  Renderer renderer = renderer_of(scene, 64, by_opengl);
  try {
    sunlit(renderer, {}, 0);
    ADD_FAILURE();
  } catch (Error const& error) {
    EXPECT_NE(std::string(error.what()).find("the terrace"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("73"), std::string::npos) << error.what();
  }
}

TEST(Schedules, TheCpuTellsAnyNumberApart) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  constexpr int sheets = 200;
  for (int i = 0; i < sheets; ++i) {
    scene.add({"sheet",
               level(-1 + 2.0 / sheets * (i + 1), -1, 0.1 + 0.01 * i, 3, 3),
               Casting::always,
               {{}, i}});
  }
  Renderer renderer = renderer_of(scene, 400, on_cpu);
  Sunlit const answer = sunlit(renderer, {}, 0);
  // Half of the sheets cover all of it, and the others begin over it one after another.
  EXPECT_EQ(answer.scheduled.size(), sheets / 2U);
  std::vector<double> factors(sheets, 1.0);
  EXPECT_NEAR(answer.at(factors), 1.0, 1e-9);
  factors[149] = 0.0;  // over all from x = 0.5 on
  EXPECT_NEAR(answer.at(factors), 0.5, 5e-3);
}

// The areas of a combination of schedules that two answers have, by its powers.
std::map<std::vector<std::pair<int, int>>, std::array<double, 2>> by_powers(Sunlit const& a,
                                                                            Sunlit const& b) {
  std::map<std::vector<std::pair<int, int>>, std::array<double, 2>> areas;
  areas[{}] = {a.projected_area, b.projected_area};
  for (ScheduledPart const& part : a.scheduled) areas[part.powers][0] = part.projected_area;
  for (ScheduledPart const& part : b.scheduled) areas[part.powers][1] = part.projected_area;
  return areas;
}

TEST(Schedules, CountedAreAsDrawn) {
  double worst = 0.0;
  std::size_t combinations = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      if (id > 0 && id % 4 != 0) surface.filter.schedule = static_cast<int>(id % 3);
      if (id % 2 == 1) surface.filter.set(AngularTransmittance{constant(0.5)});
      scene.add(surface);
    }
    Renderer drawing = renderer_of(scene, 512, by_opengl);
    Renderer counting = renderer_of(scene, 512, on_cpu);
    double const whole = area(scene[0].polygon);
    for (auto const& [powers, areas] :
         by_powers(sunlit(drawing, random.sun, 0), sunlit(counting, random.sun, 0))) {
      double const difference = (areas[0] - areas[1]) / whole;
      EXPECT_NEAR(difference, 0.0, 2e-4) << seed;
      worst = std::max(worst, std::abs(difference));
      combinations += powers.empty() ? 0 : 1;
    }
    EXPECT_EQ(counting.statistics().luminance_views, drawing.statistics().luminance_views);
  }
  std::printf("scheduled: counted and drawn differ by %.1e at most\n", worst);
  EXPECT_GT(combinations, 100U);
  EXPECT_GT(worst, 0.0);  // they are two
}

// With a glass overhang and a screen before the window.
struct ShadedRoom : Room {
  explicit ShadedRoom(bool scheduled) {
    scene.add({"overhang",
               level(0.5, -0.5, 2.6, 3, 0.5),
               Casting::always,
               {{AngularTransmittance{glass()}}}});
    scene.add({"screen",
               south_facing(1.4, -0.3, 0.5, 1.1, 1.2),
               Casting::always,
               {{}, scheduled ? 2 : -1}});
  }
};

TEST_P(Luminance, InteriorBehindShades) {
  std::vector<double> const factors{0, 0, 0.37};
  for (bool const scheduled : {false, true}) {
    ShadedRoom const room(scheduled);
    Renderer renderer = renderer_of(room.scene);
    for (SunDirection const sun :
         {sun_at(180, 10), sun_at(180, 45), sun_at(140, 20), sun_at(230, 35)}) {
      auto const got = renderer.interior_sunlit_areas(sun, room.window, room.surfaces);
      auto const exact =
          exact::interior_areas(room.scene, sun, room.window, room.surfaces, factors);
      double sum = 0.0;
      for (std::size_t i = 0; i < got.size(); ++i) {
        EXPECT_NEAR(got[i].at(factors), exact[i], 1e-3 * 3.2) << room.scene[room.surfaces[i]].name;
        sum += got[i].at(factors);
      }
      EXPECT_NEAR(sum, sunlit(renderer, sun, room.window).at(factors), 1e-3 * 3.2);
    }
  }
}

TEST(Luminance, InteriorBehindShadesIsCountedAsDrawn) {
  double worst = 0.0;
  for (bool const scheduled : {false, true}) {
    ShadedRoom room(scheduled);
    HolePattern const holes({.hole = Hole::Square, .size = 0.05, .pitch = 0.08});
    Surface sheet{"sheet", south_facing(1, -0.2, 0.8, 0.6, 1.6)};
    sheet.filter.set(
        PerforatedSheet{std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.01})});
    sheet.filter.schedule = scheduled ? 1 : -1;
    room.scene.add(sheet);
    Renderer drawing = renderer_of(room.scene, 512, by_opengl);
    Renderer counting = renderer_of(room.scene, 512, on_cpu);
    double const whole = area(room.scene[room.window].polygon);
    double lit = 0.0;
    for (SunDirection const sun :
         {sun_at(180, 10), sun_at(180, 45), sun_at(140, 20), sun_at(230, 35)}) {
      auto const a = drawing.interior_sunlit_areas(sun, room.window, room.surfaces);
      auto const b = counting.interior_sunlit_areas(sun, room.window, room.surfaces);
      for (std::size_t i = 0; i < a.size(); ++i) {
        for (auto const& [powers, areas] : by_powers(a[i], b[i])) {
          EXPECT_NEAR(areas[0] / whole, areas[1] / whole, 2e-4) << i;
          worst = std::max(worst, std::abs(areas[0] - areas[1]) / whole);
          lit += areas[1];
        }
      }
    }
    EXPECT_GT(lit, 1.0);
  }
  std::printf("inside: counted and drawn differ by %.1e at most\n", worst);
  EXPECT_GT(worst, 0.0);  // they are two
}

// By OpenGL, the two interior paths take the same pixels; the CPU samples opaque views finely.
TEST_P(Luminance, InteriorOfOpaqueShadesIsTheirCount) {
  ShadedRoom const room(false);
  Scene counted;
  Scene summed;
  for (SurfaceId id = 0; id < room.scene.size(); ++id) {
    Surface surface = room.scene[id];
    surface.filter.remove<AngularTransmittance>();
    counted.add(surface);
    if (id > room.surfaces.back()) surface.filter.set(AngularTransmittance{constant(0.0)});
    summed.add(surface);
  }
  Renderer counting = renderer_of(counted);
  Renderer summing = renderer_of(summed);
  for (SunDirection const sun : {sun_at(180, 45), sun_at(140, 20), sun_at(230, 35)}) {
    auto const a = interior_areas(counting, sun, room.window, room.surfaces);
    auto const b = interior_areas(summing, sun, room.window, room.surfaces);
    double const within = GetParam() == on_cpu ? 1e-4 : 1e-6;
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], within);
  }
}

TEST_P(Luminance, SunViewIsColouredByWhatIsLetThrough) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add(
      {"shade", level(0, -1, 1, 2, 6), Casting::always, {{AngularTransmittance{constant(0.6)}}}});
  scene.add({"scheduled", level(-1, 2, 2, 6, 3), Casting::always, {{}, 1}});
  Renderer renderer = renderer_of(scene);
  std::vector<double> const factors{0, 0.5};
  Image const image = renderer.sun_view({}, 0, 200, factors);
  auto const expect = [&](Image const& picture, int column, int row, double fraction) {
    auto const at = 3 * (static_cast<std::size_t>(row) * 200 + static_cast<std::size_t>(column));
    glm::dvec3 const drawn(picture.pixels[at], picture.pixels[at + 1], picture.pixels[at + 2]);
    EXPECT_LT(glm::distance(drawn, fraction_colour(fraction)), 2.0) << fraction;
  };
  expect(image, 140, 140, 1.0);
  expect(image, 60, 140, 0.6);
  expect(image, 140, 60, 0.5);
  expect(image, 60, 60, 0.3);
  Image const open = renderer.sun_view({}, 0, 200);
  expect(open, 140, 60, 1.0);
}

}  // namespace
}  // namespace gpu_shading
