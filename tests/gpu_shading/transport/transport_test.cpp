#include "gpu_shading/transport.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "gpu_shading/device.h"
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

  SurfaceId add_receiver(Polygon polygon, std::string name = "receiver") {
    reflectances_.push_back({});
    return scene_.add({std::move(name), std::move(polygon), Casting::never});
  }

  void add(Polygon polygon, FaceReflectances const& faces) {
    reflectances_[add(std::move(polygon), 0.0)] = faces;
  }

  struct Straight {
    double open = 0.0;    // cosine of the angle of incidence, 0 behind
    double shaded = 0.0;  // what is left of it
  };

  // Of the beam, by a grid of rays from a receiver that is a parallelogram.
  Straight straight(SurfaceId receiver, HourDirection at) const {
    constexpr int count = 8;
    RayScene const rays(scene_, {.faces = RayFaces::both});
    auto const& polygon = scene_[receiver].polygon;
    auto const sun = to_vector(to_direction(at, latitude));
    Straight straight{std::max(0.0, glm::dot(sun, normal(polygon)))};
    auto const& corners = polygon.outline;
    for (int i = 0; i < count && straight.open > 0.0; ++i) {
      for (int j = 0; j < count; ++j) {
        Ray ray{corners[0] + (i + 0.5) / count * (corners[1] - corners[0]) +
                    (j + 0.5) / count * (corners[3] - corners[0]),
                sun};
        ray.from = receiver;
        straight.shaded += straight.open * rays.transmittance(ray) / (count * count);
      }
    }
    return straight;
  }

  SurfaceId last() const { return static_cast<SurfaceId>(scene_.size() - 1); }

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

// Clear days, every 24 of them, in all hours with sun. `later`: by how many hours each is later
// than full ones, on which a table of suns has its own, from one day to the next.
std::vector<TransportHour> clear_hours(double later = 0.0) {
  std::vector<TransportHour> hours;
  for (int day = 12; day < 365; day += 24) {
    double const minutes = std::fmod(day * later, 1.0);
    for (int hour = 4; hour <= 20; ++hour) {
      HourDirection const sun{sun_of_day(day).declination, (hour + minutes - 12) * 15.0 * degree};
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

// By chance, one path in 25 would pass, and the sky's light be 10 % off.
TEST(Transport, DenseSheetLeavesLittleToChance) {
  Room room;
  auto const screen = std::make_shared<PerforatedScreen const>(
      HolePattern({.hole = Hole::Round, .size = 2 * mm, .pitch = 9 * mm}), Sheet{});
  double const open = screen->open_fraction();
  ASSERT_NEAR(open, 0.04, 0.02);
  BeamFilter filter;
  filter.set(PerforatedSheet{screen});
  room.add(south_facing(-far, -0.1, -far, 2 * far, 2 * far), 0.0, Casting::always, filter);
  auto const window = room.add_receiver(south_facing(-0.5, 0, 0, 1, 1));
  auto const hours = clear_hours();
  auto const light = room.light(window, request_for(hours), ReflectingGround{-1.0, 0.2});
  EXPECT_NEAR(light.sky_direct, 0.5 * open, 0.01 * 0.5 * open);
  // The ground sees half of the sky, and the other half through the sheet. Of its strip before the
  // sheet, a vertical patch at height h sees (1 - sin(angle to its end)) / 2 (Howell, B-1), here
  // the mean for h of 1 to 2 m.
  double const strip = 0.5 * (1.0 - (std::hypot(2.0, 0.1) - std::hypot(1.0, 0.1)));
  double const by_ground = 0.2 * 0.5 * (1.0 + open) * (strip + (0.5 - strip) * open);
  EXPECT_NEAR(light.sky.sum(), by_ground, 0.02 * by_ground);
}

struct Off {
  double hourly = 0.0;  // rms by energy
  double annual = 0.0;
};

// As TransportRequest has errors. `truth`: its lights are the suns of the hours.
Off off_by(Transported const& light, Transported const& truth, Room const& room,
           TransportRequest const& request) {
  double all = 0.0;
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t h = 0; h < request.hours.size(); ++h) {
    auto const& hour = request.hours[h];
    auto const straight = room.straight(room.last(), hour.sun);
    double const beam = truth.lights[h].sum();
    double const total = std::max(
        hour.beam * (beam + straight.shaded) + hour.diffuse * (truth.sky.sum() + truth.sky_direct),
        request.floor * (hour.beam * straight.open + hour.diffuse * 0.5));
    double const off = hour.beam * (light.beam_at(hour.sun).sum() - beam) +
                       hour.diffuse * (light.sky.sum() - truth.sky.sum());
    all += total;
    sum += off;
    squares += off * off / total;
  }
  return {std::sqrt(squares / all), std::abs(sum) / all};
}

// It is off by what was said from an answer by 30 times the rays without interpolation.
TEST(Transport, ErrorsAreThoseThatAreStated) {
  Room slats;
  slats.add(south_facing(-2, 0.01, 0, 4, 4), 0.3);
  for (int i = 0; i < 21; ++i) slats.add(level(-3, -0.12, 1 + 0.1 * i, 6, 0.1), 0.7);
  slats.add_receiver(south_facing(-1, 0, 1, 2, 2));
  Room street;
  street.add(south_facing(-40, 12, 0, 80, 15), 0.5);
  street.add_receiver(parallelogram({1, 0, 2}, {-2, 0, 0}, {0, 0, 2}));
  Room court;
  for (auto const& wall : {south_facing(-8, 8, 0, 16, 12), south_facing(-8, -8, 0, 16, 12),
                           parallelogram({-8, -8, 0}, {0, 16, 0}, {0, 0, 12}),
                           parallelogram({8, -8, 0}, {0, 16, 0}, {0, 0, 12})}) {
    court.add(wall, 0.6);
  }
  court.add_receiver(parallelogram({1, -7.99, 1}, {-2, 0, 0}, {0, 0, 2}));
  // A white sheet close before glass, which shows it the sun again.
  Room slots;
  slots.add(south_facing(-2, 0.01, 0, 4, 4), FaceReflectances{.specular = 0.3});
  BeamFilter holes;
  holes.set(PerforatedSheet{
      std::make_shared<PerforatedScreen const>(HolePattern({.hole = Hole::Slotted,
                                                            .arrangement = Arrangement::Straight,
                                                            .size = 10 * mm,
                                                            .length = 60 * mm,
                                                            .pitch = 80 * mm,
                                                            .row_pitch = 20 * mm}),
                                               Sheet{})});
  slots.add(south_facing(-3, -0.05, 0, 6, 4), 0.8, Casting::always, holes);
  slots.add_receiver(south_facing(-1, 0, 1, 2, 2));
  auto const hours = clear_hours(0.618);
  std::vector<glm::dvec3> suns;
  suns.reserve(hours.size());
  for (auto const& hour : hours) suns.push_back(to_vector(to_direction(hour.sun, latitude)));
  for (Room const* room : {&slats, &street, &court, &slots}) {
    auto request = request_for(hours);
    auto const stated = room->light(room->last(), request, ReflectingGround{}, 1);
    request.lights = suns;
    request.hourly = 1e-4;
    request.most_rays = 30 * stated.rays;
    auto const close = room->light(room->last(), request, ReflectingGround{}, 99);
    auto const off = off_by(stated, close, *room, request);
    EXPECT_LT(std::hypot(stated.noise, stated.interpolation), 0.02);
    EXPECT_LT(std::hypot(stated.annual_noise, stated.annual_interpolation), 0.005);
    double const hourly = std::hypot(stated.noise, stated.interpolation, close.noise);
    double const annual =
        std::hypot(stated.annual_noise, stated.annual_interpolation, close.annual_noise);
    EXPECT_LT(off.hourly, 1.4 * hourly);
    EXPECT_GT(off.hourly, 0.6 * hourly);
    EXPECT_LT(off.annual, 2.5 * annual);
  }
}

// Cut through slats without end, m: a strip from a to b.
struct Strip {
  glm::dvec2 a;
  glm::dvec2 b;
};

// Share of what leaves a strip that reaches the other, by crossed strings (Hottel and Sarofim,
// "Radiative Transfer", 1967).
double share_of(Strip const& from, Strip const& to) {
  double const crossed = glm::distance(from.a, to.a) + glm::distance(from.b, to.b);
  double const along = glm::distance(from.a, to.b) + glm::distance(from.b, to.a);
  return 0.5 * std::abs(crossed - along) / glm::distance(from.a, from.b);
}

// Two slats, one above the other, as strips that all see each other.
class Slats {
 public:
  static constexpr double width = 0.3;
  static constexpr double gap = 0.1;

  explicit Slats(double reflectance) : reflectance_(reflectance) {
    for (int i = 0; i < count; ++i) {
      double const from = -width + width * i / count;
      double const to = from + width / count;
      lower_.push_back({{from, 0.0}, {to, 0.0}});
      upper_.push_back({{from, gap}, {to, gap}});
    }
  }

  // What a wall at the slats' back gets by reflections of any number, if the strips of the lower
  // slat get light(strip) from outside.
  template <typename Light>
  double at_back(Light const& light) const {
    std::vector<double> low(count, 0.0);
    std::vector<double> high(count, 0.0);
    double change = 1.0;
    while (change > 1e-9) {
      change = 0.0;
      for (int face = 0; face < 2; ++face) {
        auto& mine = face == 0 ? low : high;
        auto const& other = face == 0 ? high : low;
        auto const& strips = face == 0 ? lower_ : upper_;
        auto const& others = face == 0 ? upper_ : lower_;
        for (std::size_t i = 0; i < mine.size(); ++i) {
          double sum = face == 0 ? light(strips[i]) : 0.0;
          for (std::size_t j = 0; j < other.size(); ++j) {
            sum += share_of(strips[i], others[j]) * other[j];
          }
          change = std::max(change, std::abs(reflectance_ * sum - mine[i]));
          mine[i] = reflectance_ * sum;
        }
      }
    }
    Strip const back{{0.0, 0.0}, {0.0, gap}};
    double sum = 0.0;
    for (std::size_t i = 0; i < low.size(); ++i) {
      sum += share_of(back, lower_[i]) * low[i] + share_of(back, upper_[i]) * high[i];
    }
    return sum;
  }

 private:
  static constexpr int count = 120;
  double reflectance_;
  std::vector<Strip> lower_;
  std::vector<Strip> upper_;
};

TEST(Transport, BetweenSlatsIsTheirRadiosity) {
  for (double const reflectance : {0.2, 0.5, 0.95}) {
    Room room;
    room.add(level(-far, -Slats::width, 0, 2 * far, Slats::width), reflectance);
    room.add(level(-far, -Slats::width, Slats::gap, 2 * far, Slats::width), reflectance);
    room.add(south_facing(-far, 1e-6, 0, 2 * far, Slats::gap), 0.0);
    auto const back = room.add_receiver(south_facing(-0.5, 0, 0, 1, Slats::gap));
    auto const hours = clear_hours();
    auto request = request_for(hours);
    request.hourly = 0.01;
    request.annual = 0.002;
    request.floor = 0.01;
    request.most_rays = 3'000'000;
    auto const light = room.light(back, request);
    Slats const slats(reflectance);
    double const open_sky = slats.at_back([](Strip const& strip) {
      return share_of(strip, {{-Slats::width, 0.0}, {-Slats::width, Slats::gap}});
    });
    EXPECT_NEAR(light.sky.sum(), open_sky, 0.01 * open_sky) << reflectance;
    double sum = 0.0;
    double expected_sum = 0.0;
    for (std::size_t i = 0; i < light.beam.size(); i += 5) {
      auto const& sun = light.table.suns()[i];
      if (sun.y > -0.2) continue;
      // As far as the beam reaches between them.
      double const lit = -Slats::width + Slats::gap * -sun.y / sun.z;
      double const expected = slats.at_back([&](Strip const& strip) {
        double const inside = std::clamp(lit - strip.a.x, 0.0, strip.b.x - strip.a.x);
        return sun.z * inside / (strip.b.x - strip.a.x);
      });
      EXPECT_NEAR(light.beam[i].none, expected, 0.05 * expected + 8e-3) << reflectance;
      sum += light.beam[i].none;
      expected_sum += expected;
    }
    EXPECT_NEAR(sum, expected_sum, 0.015 * expected_sum) << reflectance;
  }
}

// A vertical patch at height z sees the ground beyond the distance s by half the sine of the angle
// to it (Howell, B-1).
TEST(Transport, OfGroundUnderAnOverhangIsWhatIsLit) {
  constexpr double depth = 2.0;
  constexpr double height = 3.0;
  constexpr double z = 1.0;
  constexpr double reflectance = 0.4;
  Room room;
  room.add(level(-far, -depth, height, 2 * far, depth), 0.0);
  auto const patch = room.add_receiver(south_facing(-0.005, 0, z - 0.005, 0.01, 0.01));
  auto const hours = clear_hours();
  auto request = request_for(hours);
  request.hourly = 0.003;
  auto const light = room.light(patch, request, ReflectingGround{0.0, reflectance});
  EXPECT_NEAR(light.sky_direct, 0.5 * (height - z) / std::hypot(height - z, depth), 1e-3);
  int count = 0;
  for (std::size_t i = 0; i < light.beam.size(); ++i) {
    auto const& sun = light.table.suns()[i];
    if (sun.y > -0.1) continue;
    ++count;
    double const shaded = std::max(0.0, depth - height * -sun.y / sun.z);
    double const expected = 0.5 * reflectance * sun.z * z / std::hypot(z, shaded);
    EXPECT_NEAR(light.beam[i].once, expected, 0.02 * reflectance * sun.z) << sun.y << " " << sun.z;
    EXPECT_EQ(light.beam[i].once, light.beam[i].sum());
  }
  EXPECT_GT(count, 50);
}

// What one patch sends to another by one reflection is what the other sends to it, if both get the
// same for their areas. A fin between them hides some of each; it lies along the noon sun.
TEST(Transport, IsReciprocal) {
  auto const between = [](bool to_wall) {
    Room room;
    room.add(parallelogram({0.3, -1, 0.1}, {0, 1, 0}, {0, 0, 1}), 0.0);
    auto const floor = level(-1, -2, 0, 2.5, 2);
    auto const wall = south_facing(-0.5, 0, 0, 2, 1.6);
    room.add(to_wall ? floor : wall, 0.6);
    room.add_receiver(to_wall ? wall : floor);
    return room;
  };
  Room const from_floor = between(true);
  Room const from_wall = between(false);
  auto const hours = clear_hours();
  auto request = request_for(hours);
  request.hourly = 0.001;
  request.annual = 0.001;
  auto const on_wall = from_floor.light(from_floor.last(), request);
  auto const on_floor = from_wall.light(from_wall.last(), request);
  ASSERT_EQ(on_wall.beam.size(), on_floor.beam.size());
  int count = 0;
  for (std::size_t i = 0; i < on_wall.beam.size(); ++i) {
    auto const& sun = on_wall.table.suns()[i];
    if (std::abs(sun.x) > 1e-9) continue;
    ++count;
    double const to_wall = 3.2 * on_wall.beam[i].none / sun.z;
    double const to_floor = 5.0 * on_floor.beam[i].none / -sun.y;
    EXPECT_NEAR(to_wall, to_floor, 0.02 * to_floor) << i;
  }
  EXPECT_GE(count, 9);
}

// A mirror without end shows the whole sky, and the ground under it.
TEST(Transport, OfAMirrorIsTheSkyInIt) {
  Room room;
  room.add(parallelogram({far, -5, 0}, {-2 * far, 0, 0}, {0, 0, far}),
           FaceReflectances{.specular = 1.0});
  auto const window = room.add_receiver(south_facing(-1, 0, 1, 2, 2));
  auto const hours = clear_hours();
  auto const light = room.light(window, request_for(hours), ReflectingGround{0.0, 0.3});
  EXPECT_NEAR(light.sky.none + light.sky_direct, 0.5, 1e-3);
  EXPECT_LT(light.sky_direct, 0.01);
  EXPECT_NEAR(light.sky.once, 0.15, 1e-3);
}

// Schlick's approximation for a mirror's angle of incidence.
double at_angle(double at_normal, double cosine) {
  return at_normal + (1.0 - at_normal) * std::pow(1.0 - cosine, 5.0);
}

// A patch across the street from a mirror that faces south is lit where the mirrored ray meets it.
TEST(Transport, OfTheMirroredSunIsItsReflectanceTimesTheCosine) {
  constexpr double width = 12.0;
  constexpr double height = 9.0;
  constexpr double z = 3.0;
  constexpr double at_normal = 0.3;
  Room room;
  room.add(south_facing(-far, width, 0, 2 * far, height), FaceReflectances{.specular = at_normal});
  auto const patch =
      room.add_receiver(parallelogram({0.005, 0, z - 0.005}, {-0.01, 0, 0}, {0, 0, 0.01}));
  auto const hours = clear_hours();
  auto const light = room.light(patch, request_for(hours));
  int lit = 0;
  int unlit = 0;
  for (std::size_t i = 0; i < light.beam.size(); ++i) {
    auto const& sun = light.table.suns()[i];
    double const rise = sun.y < 0.0 ? z + width * sun.z / -sun.y : height;
    if (std::abs(rise - height) < 0.02) continue;
    bool const is_lit = rise < height;
    ++(is_lit ? lit : unlit);
    double const expected = is_lit ? at_angle(at_normal, -sun.y) * -sun.y : 0.0;
    EXPECT_NEAR(light.beam[i].none, expected, 1e-9) << sun.y << " " << sun.z;
  }
  EXPECT_GT(lit, 20);
  EXPECT_GT(unlit, 20);
}

// Ground before a mirror without end has the sun twice, and the patch sees half of it.
TEST(Transport, OfGroundBeforeAMirrorHasTheSunTwice) {
  constexpr double at_normal = 0.3;
  constexpr double reflectance = 0.4;
  Room room;
  room.add(south_facing(-far, 0, 0, 2 * far, far), FaceReflectances{.specular = at_normal});
  auto const patch = room.add_receiver(south_facing(-0.5, -0.01, 1, 1, 1));
  auto const hours = clear_hours();
  auto const light = room.light(patch, request_for(hours), ReflectingGround{0.0, reflectance});
  double sum = 0.0;
  double expected_sum = 0.0;
  for (std::size_t i = 0; i < light.beam.size(); ++i) {
    auto const& sun = light.table.suns()[i];
    if (sun.y > -0.1) continue;
    double const expected = 0.5 * reflectance * sun.z * (1.0 + at_angle(at_normal, -sun.y));
    // A path may meet the ground so far away that the mirror ends.
    EXPECT_NEAR(light.beam[i].once, expected, 0.03 * expected) << sun.y << " " << sun.z;
    sum += light.beam[i].once;
    expected_sum += expected;
  }
  EXPECT_NEAR(sum, expected_sum, 0.002 * expected_sum);
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
  auto request = request_for(hours);
  request.annual = 0.001;  // of the light of a brighter ground, errors are larger
  auto const traced = room.light(window, request, ReflectingGround{0.0, 0.2});
  auto const anew = room.light(window, request, ReflectingGround{0.0, 0.7});
  auto const black = room.light(window, request, ReflectingGround{0.0, 0.0});
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
  // Light that the ground reflects three times counts as if it did so twice: 2.1 % too little.
  EXPECT_NEAR(reweighted, sum, 0.025 * sum);
  EXPECT_NEAR(without, none, 0.02 * sum);
  EXPECT_NEAR(traced.sky.at(0.7 / 0.2), anew.sky.sum(), 0.02 * anew.sky.sum());
  for (auto const& beam : black.beam) EXPECT_EQ(beam.none, beam.sum());
}

TEST(Transport, OfTerrainIsTheGroundsByTheFaceThatIsSeen) {
  auto const up = level(-far, -far, 0, 2 * far, 2 * far);
  auto const down = parallelogram({-far, -far, 0}, {0, 2 * far, 0}, {2 * far, 0, 0});
  auto const hours = clear_hours();
  for (bool const is_up : {true, false}) {
    Room room;
    auto const window = room.add_receiver(south_facing(0, 0, 1, 2, 2));
    room.add(
        is_up ? up : down,
        FaceReflectances{.front = is_up ? 0.3 : 0.9, .back = is_up ? 0.9 : 0.3, .is_ground = true});
    auto const light = room.light(window, request_for(hours));
    EXPECT_NEAR(light.sky.once, 0.15, 1e-3);
    EXPECT_EQ(light.sky.once, light.sky.sum());
  }
}

TEST(Transport, OfSeveralReceiversIsTheSameInAnyOrderAndWithAnyThreads) {
  auto const hours = clear_hours();
  std::map<double, std::vector<double>> known;  // by height
  for (int const threads : {1, 4}) {
    Room room;
    std::vector<double> heights{9.0, 1.0, 5.0};
    if (threads == 1) std::ranges::reverse(heights);
    std::vector<SurfaceId> windows;
    windows.reserve(heights.size());
    for (double const z : heights) {
      windows.push_back(room.add_receiver(parallelogram({1, 0, z}, {-2, 0, 0}, {0, 0, 2}),
                                          "window at " + std::to_string(z)));
    }
    room.add(south_facing(-30, 8, 0, 60, 8), 0.6);
    limit_threads(threads);
    tbb::task_arena arena(threads);
    auto const lights =
        arena.execute([&] { return room.light(windows, request_for(hours), ReflectingGround{}); });
    limit_threads(4096);
    ASSERT_EQ(lights.size(), windows.size());
    for (std::size_t i = 0; i < windows.size(); ++i) {
      auto values = sums(lights[i]);
      values.insert(values.end(), {lights[i].sky.sum(), lights[i].noise});
      auto const [place, added] = known.try_emplace(heights[i], values);
      EXPECT_TRUE(added || values == place->second) << heights[i];
    }
  }
  EXPECT_EQ(known.size(), 3U);
}

TEST(Transport, RefusesWhatIsNoReflectance) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 1, 1)});
  RayScene const rays(scene);
  EXPECT_EQ(refusal_of([&] {
              Transport(scene, rays, {{1.2, 0.0}}, std::nullopt);
            }),
            "the reflectance of surface 0 is 1.2; expected 0 to 1");
  EXPECT_EQ(refusal_of([&] { Transport(scene, rays, {}, std::nullopt); }),
            "there are 0 reflectances; expected 1, one for each surface");
  EXPECT_EQ(refusal_of([&] {
              Transport(scene, rays, {{0.3, 0.6, false, 0.5}}, std::nullopt);
            }),
            "the reflectance of surface 0 is 1.1; expected 0 to 1");
}

}  // namespace
}  // namespace gpu_shading
