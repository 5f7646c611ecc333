#include "calculation/shade_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "runs/schedule_value.h"
#include "scene/shade_motion.h"
#include "support/shapes.h"

namespace gpu_shading::energyplus {
namespace {

using State = ShadeControl::State;

constexpr double awning_depth = 2.0;

Surface drawn_surface(std::string name, Ring outline) {
  Surface surface;
  surface.name = std::move(name);
  surface.polygon = {std::move(outline), {}};
  return surface;
}

MovingShade awning_of(MovingShade::Control control) {
  MovingShade shade;
  shade.name = "Awning";
  shade.where = "GPUShading:MovingShade Awning";
  shade.surfaces = {"AWNING"};
  shade.motion = MovingShade::Motion::extend;
  shade.direction = {0, -1, 0};
  shade.maximum = 1.0;
  shade.step = 0.1;
  shade.control = control;
  if (control == MovingShade::Control::schedule) {
    shade.schedule = "POSITION";
  } else {
    shade.receivers = "WINDOW";
  }
  return shade;
}

// A window of 1 x 1 m to the south under a wide awning, and the control of the awning.
class ShadedRoom {
 public:
  explicit ShadedRoom(MovingShade shade) : scene_(model_of(std::move(shade))) {
    scene_.add(drawn_surface("WINDOW", {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}));
    scene_.add(drawn_surface(
        "AWNING", {{-9, 0, 1}, {-9, -awning_depth, 1}, {10, -awning_depth, 1}, {10, 0, 1}}));
    auto const value = [this](std::string const& name, Moment) {
      return checked_value(name, schedules.at(name));
    };
    scene_.complete({[](std::string const&) { return std::pair{0.0, 1.0}; }, value, value});
    control_.emplace(scene_);
  }

  ShadeControl::Decision decide(std::optional<SunDirection> sun) {
    control_->set_time({12, 1});
    return control_
        ->decide(sun, {[this] {
                         ++asked_for_beam_;
                         return beam;
                       },
                       [this] { return wind; }})
        .front();
  }
  int asked_for_beam() const { return asked_for_beam_; }

  std::map<std::string, double> schedules{{"POSITION", 0.43}, {"AVAILABLE", 1.0}};
  double beam = 300.0;
  double wind = 5.0;

 private:
  static Model model_of(MovingShade shade) {
    Model model;
    model.shading = read_shading_input(read_idf("Shading:Building:Detailed,Awning;"));
    model.options.device.device = DeviceId{};
    model.moving_shades.push_back(std::move(shade));
    return model;
  }

  SceneAssembly scene_;
  std::optional<ShadeControl> control_;
  int asked_for_beam_ = 0;
};

// In the south, where an awning of this share of the depth covers the window.
SunDirection covered_by(double share) {
  return {std::numbers::pi, std::atan(1.0 / (awning_depth * share))};
}

TEST(ShadeControl, BlockBeamExtendsAsFarAsTheBeamNeeds) {
  ShadedRoom room(awning_of(MovingShade::Control::block_beam));
  auto const blocking = room.decide(covered_by(0.46));
  EXPECT_DOUBLE_EQ(blocking.position, 0.5);
  EXPECT_EQ(blocking.state, State::blocking);
  auto const north = room.decide(SunDirection{0.0, 0.5});
  EXPECT_EQ(north.position, 0.0);
  EXPECT_EQ(north.state, State::clear);
  auto const low = room.decide(covered_by(1.2));
  EXPECT_EQ(low.position, 1.0);
  EXPECT_EQ(low.state, State::admitting);
  auto const night = room.decide(std::nullopt);
  EXPECT_EQ(night.position, 0.0);
  EXPECT_EQ(night.state, State::at_rest);
  EXPECT_EQ(room.asked_for_beam(), 0);
}

TEST(ShadeControl, HysteresisHoldsWhatStillBlocks) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.hysteresis = 0.15;
  ShadedRoom room(shade);
  EXPECT_DOUBLE_EQ(room.decide(covered_by(0.46)).position, 0.5);
  auto const higher = room.decide(covered_by(0.36));
  EXPECT_DOUBLE_EQ(higher.position, 0.5);
  EXPECT_EQ(higher.state, State::held);
  // Too little now, although it is near enough.
  auto const lower = room.decide(covered_by(0.56));
  EXPECT_DOUBLE_EQ(lower.position, 0.6);
  EXPECT_EQ(lower.state, State::blocking);
  EXPECT_DOUBLE_EQ(room.decide(covered_by(0.36)).position, 0.4);
}

TEST(ShadeControl, RestsWhileItIsNotAvailable) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.availability = "AVAILABLE";
  ShadedRoom room(shade);
  EXPECT_EQ(room.decide(covered_by(0.46)).state, State::blocking);
  room.schedules["AVAILABLE"] = 0.0;
  auto const rests = room.decide(covered_by(0.46));
  EXPECT_EQ(rests.position, 0.0);
  EXPECT_EQ(rests.state, State::at_rest);
}

TEST(ShadeControl, RestsBelowTheMinimumBeamOnTheReceivers) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.minimum_beam = 200.0;
  ShadedRoom room(shade);
  auto const sun = covered_by(0.5 - 1e-3);  // close to 45 degrees
  room.beam = 1.01 * 200.0 / std::cos(sun.altitude);
  EXPECT_EQ(room.decide(sun).state, State::blocking);
  room.beam = 0.99 * 200.0 / std::cos(sun.altitude);
  EXPECT_EQ(room.decide(sun).state, State::at_rest);
  EXPECT_EQ(room.asked_for_beam(), 2);
}

TEST(ShadeControl, RestsInWindFasterThanItsLimit) {
  for (auto const control : {MovingShade::Control::block_beam, MovingShade::Control::schedule}) {
    auto shade = awning_of(control);
    shade.maximum_wind = 5.0;
    ShadedRoom room(shade);
    EXPECT_GT(room.decide(covered_by(0.46)).position, 0.0);
    room.wind = 5.1;
    auto const rests = room.decide(covered_by(0.46));
    EXPECT_EQ(rests.position, 0.0);
    EXPECT_EQ(rests.state, State::windy);
    EXPECT_EQ(room.decide(std::nullopt).state, State::windy);
  }
}

TEST(ShadeControl, RoundsWhatAScheduleWants) {
  ShadedRoom room(awning_of(MovingShade::Control::schedule));
  auto decision = room.decide(std::nullopt);
  EXPECT_DOUBLE_EQ(decision.position, 0.4);
  EXPECT_DOUBLE_EQ(decision.exact, 0.43);
  EXPECT_EQ(decision.state, State::scheduled);
  room.schedules["POSITION"] = 7.0;
  decision = room.decide(std::nullopt);
  EXPECT_EQ(decision.position, 1.0);
  EXPECT_EQ(decision.exact, 1.0);
}

TEST(ShadeControl, RefusesAPositionOrAvailabilityThatIsNotANumber) {
  auto const nan = std::numeric_limits<double>::quiet_NaN();
  ShadedRoom scheduled(awning_of(MovingShade::Control::schedule));
  scheduled.schedules["POSITION"] = nan;
  EXPECT_THAT(
      [&] { scheduled.decide(std::nullopt); },
      testing::ThrowsMessage<Error>(testing::HasSubstr(
          "GPUShading:MovingShade Awning: Position Schedule Name: schedule \"POSITION\" has "
          "the value nan; expected a finite number")));
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.availability = "AVAILABLE";
  ShadedRoom available(shade);
  available.schedules["AVAILABLE"] = nan;
  EXPECT_THAT([&] { available.decide(covered_by(0.46)); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("Availability Schedule Name")));
}

TEST(ShadeControl, TakesAShareWithinTheToleranceAsNoBeam) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  for (auto const& [tolerance, position] :
       {std::pair(0.0, 0.5), {0.02, 0.5}, {0.14, 0.4}, {0.6, 0.2}}) {
    shade.tolerance = tolerance;
    // At 0.4 and 0.2, the awning leaves 13 % and 57 % of the window lit.
    auto const decision = ShadedRoom(shade).decide(covered_by(0.46));
    EXPECT_DOUBLE_EQ(decision.position, position) << tolerance;
    EXPECT_EQ(decision.state, State::blocking);
  }
}

TEST(ShadeControl, ReceiversMustBeInTheModel) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.receivers = "WINDOWS";
  EXPECT_THAT([&] { ShadedRoom const room(shade); },
              testing::ThrowsMessage<Error>(testing::HasSubstr(
                  "Receiver Name \"WINDOWS\": no exterior surface matches; did you mean WINDOW?")));
}

// A window of 2 x 1 m to the south, behind obstacles and slats, panels or an awning that move.
struct RandomScene {
  std::vector<Polygon> fixed;
  std::vector<Polygon> moving;
  MovingShade shade;
  SunDirection sun;
};

constexpr double window_width = 2.0;
constexpr double window_height = 1.0;

RandomScene random_scene(unsigned seed) {
  std::mt19937 engine(seed);
  auto const between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  RandomScene random;
  auto& shade = random.shade;
  shade.control = MovingShade::Control::block_beam;
  shade.receivers = "WINDOW";
  double const out = between(0.1, 0.5);
  if (seed % 3 == 0) {
    shade.motion = MovingShade::Motion::rotate;
    shade.maximum = between(30.0, 90.0);
    shade.step = between(3.0, 15.0);
    double const pitch = between(0.2, 0.35);
    for (double z = -0.6; z < window_height + 0.6; z += pitch) {
      random.moving.push_back(level(-4.0, -out - 0.15, z, 10.0, 0.3));
    }
  } else if (seed % 3 == 1) {
    shade.motion = MovingShade::Motion::slide;
    shade.direction = {1, 0, 0};
    shade.minimum = between(-1.0, 0.0);
    shade.maximum = between(1.0, 4.0);
    shade.step = between(0.1, 0.4);
    random.moving.push_back(south_facing(between(-4.0, -2.0), -out, -1.0, between(2.0, 4.0), 3.0));
  } else {
    shade.motion = MovingShade::Motion::extend;
    shade.direction = {0, -1, 0};
    shade.maximum = 1.0;
    shade.step = between(0.05, 0.2);
    random.moving.push_back(
        parallelogram({-5, 0, window_height}, {0, -between(0.5, 3.0), 0}, {12, 0, 0}));
  }
  shade.rest = shade.nearest(between(shade.minimum, shade.maximum));
  for (int i = 0; i < 3; ++i) {
    random.fixed.push_back(south_facing(between(-2.0, 3.0), -between(0.6, 4.0), between(-1.0, 1.0),
                                        between(0.2, 1.5), between(0.2, 2.0)));
  }
  random.sun = sun_at(between(100.0, 260.0), between(5.0, 70.0));
  return random;
}

// Whether a ray to the sun meets a parallelogram.
bool is_met(Polygon const& polygon, glm::dvec3 const& from, glm::dvec3 const& towards_sun) {
  auto const& ring = polygon.outline;
  glm::dvec3 const a = ring[1] - ring[0];
  glm::dvec3 const b = ring[3] - ring[0];
  glm::dvec3 const up = glm::cross(a, b);
  double const slope = glm::dot(up, towards_sun);
  if (std::abs(slope) < 1e-12) return false;
  double const along = glm::dot(up, ring[0] - from) / slope;
  if (along <= 0.0) return false;
  glm::dvec3 const at = from + along * towards_sun - ring[0];
  double const u = glm::dot(glm::cross(at, b), up) / glm::dot(up, up);
  double const v = glm::dot(glm::cross(a, at), up) / glm::dot(up, up);
  return u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
}

// How many of 4,096 points of the window are lit, if it is larger by a share.
int lit_points(RandomScene const& random, double position, double larger) {
  std::vector<Polygon> casters = random.fixed;
  for (auto const& polygon : random.moving) {
    casters.push_back(moved(polygon, random.shade, position));
    if (area(casters.back()) <= 0.0) casters.pop_back();
  }
  auto const towards_sun = to_vector(random.sun);
  constexpr int points = 4096;
  int lit = 0;
  for (int i = 0; i < points; ++i) {
    // No two are in one row or column, so that slits are found wherever they run.
    auto const within = [&](double step) {
      return 0.5 + (1.0 + larger) * (glm::fract(i * step) - 0.5);
    };
    glm::dvec3 const point(window_width * within(0.7548776662466927), 0.0,
                           window_height * within(0.5698402909980532));
    bool const stopped = std::any_of(casters.begin(), casters.end(), [&](auto const& polygon) {
      return is_met(polygon, point, towards_sun);
    });
    if (!stopped) ++lit;
  }
  return lit;
}

ShadeControl::Decision decided(RandomScene const& random) {
  Model model;
  model.options.device.device = DeviceId{};
  model.moving_shades = {random.shade};
  std::string idf;
  auto const name = [](std::size_t i) { return "MOVING " + std::to_string(i); };
  for (std::size_t i = 0; i < random.moving.size(); ++i) {
    idf += "Shading:Building:Detailed," + name(i) + ";";
    model.moving_shades.front().surfaces.push_back(name(i));
  }
  model.shading = read_shading_input(read_idf(idf));
  SceneAssembly scene(std::move(model));
  scene.add({"WINDOW", south_facing(0, 0, 0, window_width, window_height)});
  for (auto const& polygon : random.fixed) scene.add({"FIXED", polygon});
  for (std::size_t i = 0; i < random.moving.size(); ++i) scene.add({name(i), random.moving[i]});
  auto const none = [](std::string const&, Moment) { return 0.0; };
  scene.complete({[](std::string const&) { return std::pair{0.0, 1.0}; }, none, none});
  ShadeControl control(scene);
  control.set_time({12, 1});
  return control.decide(random.sun, {}).front();
}

// A panel of 1.6 m slides from the west before a window of 2 m.
TEST(ShadeControl, AdmitsTheLeastBeamWhereNoPositionBlocksIt) {
  RandomScene random;
  random.shade.motion = MovingShade::Motion::slide;
  random.shade.direction = {1, 0, 0};
  random.shade.maximum = 4.0;
  random.shade.step = 0.1;
  random.shade.control = MovingShade::Control::block_beam;
  random.shade.receivers = "WINDOW";
  random.moving.push_back(south_facing(-2.0, -0.1, -1.0, 1.6, 3.0));
  random.sun = sun_at(180.0, 5.0);
  auto const decision = decided(random);
  EXPECT_EQ(decision.state, State::admitting);
  EXPECT_NEAR(decision.position, 2.0, 1e-9);  // the nearest to rest of 2.0 to 2.4
}

// A window that is a little larger tells slivers from darkness.
constexpr double with_rim = 0.03;

// Of 4,096: what the points may be off by, and what positions must differ by to be told apart.
constexpr int few_points = 16;

void expect_nearest_of_the_least(RandomScene const& random,
                                 ShadeControl::Decision const& decision) {
  int const admitted = lit_points(random, decision.position, 0.0);
  double const moves = std::abs(decision.position - random.shade.rest);
  for (double const position : random.shade.positions()) {
    int const lit = lit_points(random, position, 0.0);
    EXPECT_LE(admitted, lit + few_points) << position;
    if (std::abs(position - random.shade.rest) > moves - 1e-9) continue;
    EXPECT_GT(lit, admitted - few_points) << position;
  }
}

void expect_nearest_without_beam(RandomScene const& random,
                                 ShadeControl::Decision const& decision) {
  auto const all = random.shade.positions();
  bool const some_dark = std::any_of(all.begin(), all.end(), [&](double position) {
    return lit_points(random, position, with_rim) == 0;
  });
  if (decision.state == State::admitting) {
    EXPECT_FALSE(some_dark);
    expect_nearest_of_the_least(random, decision);
    return;
  }
  EXPECT_EQ(lit_points(random, decision.position, 0.0), 0);
  double const moves = std::abs(decision.position - random.shade.rest);
  for (double const position : all) {
    if (std::abs(position - random.shade.rest) > moves - 1e-9) continue;
    EXPECT_GT(lit_points(random, position, with_rim), 0) << position;
  }
}

TEST(ShadeControl, BlockBeamLeavesNoBeamWhereSomePositionHasNone) {
  std::map<State, int> found;
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    auto const random = random_scene(seed);
    auto const decision = decided(random);
    ++found[decision.state];
    expect_nearest_without_beam(random, decision);
  }
  EXPECT_GT(found[State::blocking], 20);
  EXPECT_GT(found[State::admitting], 20);
  EXPECT_GT(found[State::clear], 10);
}

}  // namespace
}  // namespace gpu_shading::energyplus
