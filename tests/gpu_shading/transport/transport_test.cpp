#include "gpu_shading/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/sun_direction.h"
#include "support/millimetre.h"
#include "support/refusal.h"
#include "support/shapes.h"
#include "transport/sobol_points.h"

namespace gpu_shading {
namespace {

constexpr double far = 1e4;  // m, half of what stands for a surface without end
constexpr double latitude = 40.0 * degree;

// A scene whose surfaces have a reflectance on both faces.
class Room {
 public:
  SurfaceId add(Polygon polygon, double reflectance, Casting casting = Casting::always,
                BeamFilter filter = {}) {
    reflectances_.push_back({reflectance, reflectance});
    return scene_.add({"surface", std::move(polygon), casting, std::move(filter)});
  }

  SurfaceId add_receiver(Polygon polygon) { return add(std::move(polygon), 0.0, Casting::never); }

  void add_ground(Polygon polygon, double reflectance) {
    reflectances_[add(std::move(polygon), reflectance)].is_ground = true;
  }

  Transported light(SurfaceId receiver, TransportRequest const& request,
                    std::optional<ReflectingGround> ground = {}, std::uint32_t seed = 0) const {
    RayScene const rays(scene_, {.faces = RayFaces::both});
    return Transport(scene_, rays, reflectances_, ground).to(receiver, request, {}, seed);
  }

  std::vector<Transported> light(std::span<SurfaceId const> receivers,
                                 TransportRequest const& request,
                                 std::optional<ReflectingGround> ground = {}) const {
    RayScene const rays(scene_, {.faces = RayFaces::both});
    return Transport(scene_, rays, reflectances_, ground).to(receivers, request);
  }

 private:
  Scene scene_;
  std::vector<FaceReflectances> reflectances_;
};

// Clear days, every 24 of them, in all hours with sun.
std::vector<TransportHour> clear_hours() {
  std::vector<TransportHour> hours;
  for (int day = 12; day < 365; day += 24) {
    for (int hour = 4; hour <= 20; ++hour) {
      HourDirection const sun{sun_of_day(day).declination, (hour - 12) * 15.0 * degree};
      double const up = to_vector(to_direction(sun, latitude)).z;
      if (up > 0.02) hours.push_back({sun, 950.0 * std::exp(-0.15 / up), 90.0 * std::sqrt(up)});
    }
  }
  return hours;
}

TransportRequest request_for(std::vector<TransportHour> const& hours) {
  return {.latitude = latitude, .hours = hours};
}

std::vector<double> sums(Transported const& light) {
  std::vector<double> sums;
  for (auto const& beam : light.beam) sums.push_back(beam.sum());
  return sums;
}

// The sun of an hour, 0 below the horizon.
double height_of(HourDirection sun) { return to_vector(to_direction(sun, latitude)).z; }

// The first two dimensions are a (0, 8, 2)-net in base 2, which Owen's scrambling keeps.
TEST(SobolPoints, AreOneInEachCell) {
  SobolPoints const points(256, 4);
  for (std::uint32_t const seed : {0U, 7U}) {
    for (std::size_t const across : {1UL, 4UL, 16UL, 256UL}) {
      std::vector<int> cells(points.count(), 0);
      for (std::size_t i = 0; i < points.count(); ++i) {
        auto const cell = [&](std::size_t dimension, std::size_t count) {
          return static_cast<std::size_t>(double(count) * points.at(i, dimension, seed));
        };
        ++cells[cell(0, across) * (points.count() / across) + cell(1, points.count() / across)];
      }
      EXPECT_EQ(cells, std::vector<int>(points.count(), 1)) << seed << " " << across;
    }
  }
}

TEST(Transport, OfOpenGroundIsItsViewFactorTimesItsReflectance) {
  Room room;
  auto const window = room.add_receiver(south_facing(0, 0, 1, 2, 2));
  auto const hours = clear_hours();
  auto const light = room.light(window, request_for(hours), ReflectingGround{0.0, 0.3});
  for (auto const& hour : hours) {
    EXPECT_NEAR(light.beam_at(hour.sun).sum(), 0.3 * 0.5 * height_of(hour.sun), 1.5e-3);
  }
  for (auto const& beam : light.beam) EXPECT_EQ(beam.once, beam.sum());
  EXPECT_EQ(light.sky.once, light.sky.sum());
  EXPECT_NEAR(light.sky.sum(), 0.15, 1e-3);
  EXPECT_NEAR(light.sky_direct, 0.5, 1e-3);
}

// All that is white under a uniform sky has the sky's radiance.
TEST(Transport, OfAFurnaceIsWhole) {
  Room room;
  for (auto const& wall : {south_facing(-5, 5, 0, 10, 12), south_facing(-5, -5, 0, 10, 12),
                           parallelogram({-5, -5, 0}, {0, 10, 0}, {0, 0, 12}),
                           parallelogram({5, -5, 0}, {0, 10, 0}, {0, 0, 12})}) {
    room.add(wall, 1.0);
  }
  for (int i = 0; i < 10; ++i) room.add(level(-3, 4.2, 1 + 0.2 * i, 4, 0.5), 1.0);
  auto const window = room.add_receiver(south_facing(-2, 4.9, 1, 2, 2));
  auto const hours = clear_hours();
  auto const light = room.light(window, request_for(hours), ReflectingGround{0.0, 1.0});
  EXPECT_NEAR(light.sky.sum() + light.sky_direct, 1.0, 1e-9);
  EXPECT_LT(light.sky_direct, 0.5);
}

// A point at height z sees a wall without end, of height h at distance w, by half the difference of
// the sines of the angles to its edges (Howell, "A Catalog of Radiation Heat Transfer Configuration
// Factors", B-1).
TEST(Transport, OfALitWallAcrossAStreetIsItsViewFactor) {
  constexpr double width = 12.0;
  constexpr double height = 9.0;
  constexpr double z = 3.0;
  Room room;
  // Faces south, and is lit; the receiver in front of it faces north.
  room.add(south_facing(-far, width, 0, 2 * far, height), 0.6);
  auto const patch =
      room.add_receiver(parallelogram({0.005, 0, z - 0.005}, {-0.01, 0, 0}, {0, 0, 0.01}));
  auto const sine = [](double rise) { return rise / std::hypot(rise, width); };
  double const factor = 0.5 * (sine(height - z) + sine(z));
  auto const hours = clear_hours();
  auto const light = room.light(patch, request_for(hours));
  for (auto const& hour : hours) {
    auto const sun = to_vector(to_direction(hour.sun, latitude));
    double const cosine = std::max(0.0, -sun.y);
    // The sun turns behind the wall between two suns of the table.
    if (std::abs(sun.y) < 0.12) continue;
    EXPECT_NEAR(light.beam_at(hour.sun).sum(), 0.6 * cosine * factor, 3e-3);
  }
  EXPECT_EQ(light.sky.none, light.sky.sum());
}

// Between a level sheet without end that passes the share f and the ground, light is reflected for
// ever: the ground gets f E / (1 - (1 - f) r g), by a geometric series.
TEST(Transport, BetweenASheetAndTheGroundIsAGeometricSeries) {
  for (double const reflectance : {0.0, 0.5, 1.0}) {
    Room room;
    auto const screen = std::make_shared<PerforatedScreen const>(
        HolePattern({.hole = Hole::Round, .size = 6 * mm, .pitch = 9 * mm}), Sheet{});
    double const open = screen->open_fraction();
    BeamFilter filter;
    filter.set(PerforatedSheet{screen});
    room.add(level(-far, -far, 1, 2 * far, 2 * far), reflectance, Casting::always, filter);
    auto const patch =
        room.add_receiver(parallelogram({0, 0, 0.5}, {0, 0.01, 0}, {0.01, 0, 0}));  // faces down
    auto const hours = clear_hours();
    constexpr double ground = 0.8;
    auto const light = room.light(patch, request_for(hours), ReflectingGround{0.0, ground});
    double const series = ground * open / (1.0 - (1.0 - open) * reflectance * ground);
    for (auto const& hour : hours) {
      double const expected = series * height_of(hour.sun);
      EXPECT_NEAR(light.beam_at(hour.sun).sum(), expected, 0.03 * series) << reflectance;
    }
    EXPECT_NEAR(light.sky.sum(), series, 0.02 * series) << reflectance;
  }
}

// What an independent answer is off by is what was said.
TEST(Transport, ErrorsAreThoseThatAreStated) {
  Room room;
  room.add(south_facing(-2, 0.01, 0, 4, 4), 0.3);
  for (int i = 0; i < 21; ++i) room.add(level(-3, -0.12, 1 + 0.1 * i, 6, 0.1), 0.7);
  auto const window = room.add_receiver(south_facing(-1, 0, 1, 2, 2));
  auto const hours = clear_hours();
  auto request = request_for(hours);
  auto const stated = room.light(window, request, ReflectingGround{}, 1);
  EXPECT_LT(stated.noise, 0.02);
  EXPECT_LT(stated.annual_noise, 0.005);
  request.hourly = 0.002;
  request.annual = 0.001;
  request.most_rays = 20'000'000;
  auto const close = room.light(window, request, ReflectingGround{}, 99);
  double off = 0.0;
  double all = 0.0;
  for (auto const& hour : hours) {
    double const sum = hour.beam * close.beam_at(hour.sun).sum() +
                       hour.diffuse * (close.sky.sum() + close.sky_direct);
    off += hour.beam * (stated.beam_at(hour.sun).sum() - close.beam_at(hour.sun).sum()) +
           hour.diffuse * (stated.sky.sum() - close.sky.sum());
    all += sum;
  }
  EXPECT_LT(std::abs(off) / all, 3.0 * stated.annual_noise + 0.002);
}

TEST(Transport, IsTheSameAgain) {
  Room room;
  for (int i = 0; i < 5; ++i) room.add(level(-3, -0.6, 1 + 0.4 * i, 6, 0.5), 0.7);
  auto const window = room.add_receiver(south_facing(-1, 0, 1, 2, 2));
  auto const hours = clear_hours();
  auto const once = room.light(window, request_for(hours), ReflectingGround{});
  auto const again = room.light(window, request_for(hours), ReflectingGround{});
  EXPECT_EQ(sums(once), sums(again));
  EXPECT_EQ(once.sky.sum(), again.sky.sum());
  EXPECT_EQ(once.noise, again.noise);
}

TEST(Transport, TellsTheGroundsReflectionsApart) {
  Room room;
  room.add(south_facing(-far, 0.01, 0, 2 * far, 12), 0.6);
  room.add(level(-20, -4, 3, 40, 4), 0.5);
  auto const window = room.add_receiver(south_facing(-1, 0, 1, 2, 1.5));
  auto const hours = clear_hours();
  auto const traced = room.light(window, request_for(hours), ReflectingGround{0.0, 0.2});
  auto const anew = room.light(window, request_for(hours), ReflectingGround{0.0, 0.7});
  auto const black = room.light(window, request_for(hours), ReflectingGround{0.0, 0.0});
  double reweighted = 0.0;
  double sum = 0.0;
  double without = 0.0;
  double none = 0.0;
  for (auto const& hour : hours) {
    reweighted += hour.beam * traced.beam_at(hour.sun).at(0.7 / 0.2);
    sum += hour.beam * anew.beam_at(hour.sun).sum();
    without += hour.beam * traced.beam_at(hour.sun).at(0.0);
    none += hour.beam * black.beam_at(hour.sun).sum();
  }
  EXPECT_NEAR(reweighted, sum, 0.02 * sum);
  EXPECT_NEAR(without, none, 0.02 * sum);
  EXPECT_NEAR(traced.sky.at(0.7 / 0.2), anew.sky.sum(), 0.02 * anew.sky.sum());
  for (auto const& beam : black.beam) EXPECT_EQ(beam.none, beam.sum());
}

TEST(Transport, OfTerrainIsTheGrounds) {
  Room room;
  room.add_ground(level(-far, -far, 0, 2 * far, 2 * far), 0.3);
  auto const window = room.add_receiver(south_facing(0, 0, 1, 2, 2));
  auto const hours = clear_hours();
  auto const light = room.light(window, request_for(hours));
  EXPECT_NEAR(light.sky.once, 0.15, 1e-3);
  EXPECT_EQ(light.sky.once, light.sky.sum());
}

TEST(Transport, OfSeveralReceiversIsInTheirOrder) {
  Room room;
  std::vector<SurfaceId> windows;
  for (double const z : {9.0, 1.0, 5.0}) {
    windows.push_back(room.add_receiver(parallelogram({1, 0, z}, {-2, 0, 0}, {0, 0, 2})));
  }
  room.add(south_facing(-30, 8, 0, 60, 8), 0.6);
  auto const hours = clear_hours();
  auto const lights = room.light(windows, request_for(hours));
  ASSERT_EQ(lights.size(), windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    auto const alone = room.light(windows[i], request_for(hours), {}, 12);
    EXPECT_NEAR(lights[i].sky.sum(), alone.sky.sum(), 0.03 * alone.sky.sum());
  }
}

TEST(Transport, RefusesWhatIsNoReflectance) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 1, 1)});
  RayScene const rays(scene);
  EXPECT_EQ(refusal_of([&] {
              Transport(scene, rays, {{1.2, 0.0, false}}, std::nullopt);
            }),
            "the reflectance of surface 0 is 1.2; expected 0 to 1");
  EXPECT_EQ(refusal_of([&] { Transport(scene, rays, {}, std::nullopt); }),
            "there are 0 reflectances; expected 1, one for each surface");
}

}  // namespace
}  // namespace gpu_shading
