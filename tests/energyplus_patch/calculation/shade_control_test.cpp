#include "calculation/shade_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"

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
    auto const value = [this](std::string const& name, Moment) { return schedules.at(name); };
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

TEST(ShadeControl, ReceiversMustBeInTheModel) {
  auto shade = awning_of(MovingShade::Control::block_beam);
  shade.receivers = "WINDOWS";
  EXPECT_THAT([&] { ShadedRoom const room(shade); },
              testing::ThrowsMessage<Error>(testing::HasSubstr(
                  "Receiver Name \"WINDOWS\": no exterior surface matches; did you mean WINDOW?")));
}

}  // namespace
}  // namespace gpu_shading::energyplus
