#include "reports/run_record.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/degree.h"

namespace gpu_shading::energyplus {
namespace {

// A wall of 2 m2 to the south that may be shaded, one to the north, and a roof of 3 m2.
RunRecord record_of_a_box() {
  return RunRecord({{0.0, -2.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 3.0}}, {0, 1, 2});
}

RunDay day_of(int month, int day, bool warm_up = false) {
  return {RunDay::Kind::run_period, 1, month, day, warm_up, 1};
}

// The same at all hours.
auto beam_of(double beam) {
  return [beam] { return std::vector<double>(24, beam); };
}

SunDirection const noon{180.0 * degree, 60.0 * degree};

// The wall is half in the sun at 12:00 alone.
void shade(RunRecord& record) {
  record.begin_step({12, 1});
  record.set_sun(noon);
  record.note(0, 0.5 * 2.0 * std::cos(60.0 * degree));
}

double beam_of_run(RunRecord const& record, std::size_t receiver) {
  return record.light()[receiver].of_run(ReceivedLight::beam);
}

TEST(RunRecord, AddsTheBeamOfDaysWithoutWarmUp) {
  auto record = record_of_a_box();
  record.begin_day(day_of(3, 1, true), beam_of(500.0));
  shade(record);
  record.begin_day(day_of(3, 1, true), beam_of(500.0));
  record.begin_day(day_of(3, 1), beam_of(500.0));
  record.begin_day(day_of(3, 2), beam_of(300.0));  // with the shadows of the day before
  record.end();
  EXPECT_EQ(record.simulated(), 2U);
  ASSERT_EQ(record.days().size(), 1U);
  auto const& hours = record.days().front().hours;
  ASSERT_EQ(hours.size(), 1U);
  EXPECT_EQ(hours.front().hour, 12);
  EXPECT_NEAR(hours.front().fractions[0], 0.5, 1e-6);
  EXPECT_LT(hours.front().fractions[1], 0.0F);
  // Nothing can shade the roof: EnergyPlus does not ask about it.
  EXPECT_EQ(hours.front().fractions[2], 1.0F);
  EXPECT_NEAR(beam_of_run(record, 0), 0.8 * 0.5 * std::cos(60.0 * degree), 1e-6);
  auto const& light = record.light()[0];
  EXPECT_EQ(light.at(ReceivedLight::beam, 2, 11), beam_of_run(record, 0));
  EXPECT_EQ(light.of_month(ReceivedLight::beam, 2), beam_of_run(record, 0));
  EXPECT_EQ(light.of_month(ReceivedLight::beam, 3), 0.0);
  EXPECT_EQ(record.days_of_months()[2], 2);
  EXPECT_FALSE(record.has_diffuse());
  EXPECT_EQ(hours.front().beam, 400.0);  // the mean of both days
  EXPECT_EQ(beam_of_run(record, 1), 0.0);
  EXPECT_NEAR(beam_of_run(record, 2), 0.8 * std::sin(60.0 * degree), 1e-6);
}

TEST(RunRecord, AddsLightThatIsNotBeamByMonthAndHour) {
  auto record = record_of_a_box();
  std::vector<DiffuseLight> const light{{100.0, 20.0, 3.0}, {50.0, 10.0, 0.0}, {}};
  auto day = day_of(3, 31, true);
  day.steps_per_hour = 2;
  record.begin_day(day, beam_of(0.0));
  record.note_diffuse(10, light);  // of the warm-up
  day.warm_up = false;
  record.begin_day(day, beam_of(0.0));
  record.note_diffuse(10, light);
  record.note_diffuse(10, light);
  record.note_diffuse(11, light);
  day.month = 4;
  record.begin_day(day, beam_of(0.0));
  record.note_diffuse(10, light);
  record.end();
  EXPECT_TRUE(record.has_diffuse());
  auto const& wall = record.light()[0];
  EXPECT_NEAR(wall.at(ReceivedLight::sky, 2, 9), 0.1, 1e-12);
  EXPECT_NEAR(wall.at(ReceivedLight::sky, 2, 10), 0.05, 1e-12);
  EXPECT_NEAR(wall.of_month(ReceivedLight::by_ground, 2), 0.03, 1e-12);
  EXPECT_NEAR(wall.of_month(ReceivedLight::by_ground, 3), 0.01, 1e-12);
  EXPECT_NEAR(wall.of_run(ReceivedLight::by_shades), 0.006, 1e-12);
  EXPECT_NEAR(record.light()[1].of_run(ReceivedLight::sky), 0.1, 1e-12);
  EXPECT_EQ(wall.of_run(ReceivedLight::beam), 0.0);
}

TEST(RunRecord, KeepsTheSharesOfTheTimestepAtTheEndOfEachHour) {
  auto record = record_of_a_box();
  auto day = day_of(1, 21);
  day.steps_per_hour = 2;
  record.begin_day(day, beam_of(0.0));
  for (int const step : {1, 2}) {
    record.begin_step({12, step}, {0.25F * static_cast<float>(step), 1.0F});
    record.set_sun(noon);
  }
  record.end();
  ASSERT_EQ(record.days().size(), 1U);
  EXPECT_EQ(record.days().front().hours.front().shares, (std::vector<float>{0.5F, 1.0F}));
}

// With shadows at every timestep, EnergyPlus begins the day at each of them.
TEST(RunRecord, AsksForTheBeamOnceADay) {
  auto record = record_of_a_box();
  int asked = 0;
  auto const begin = [&](int day, bool warm_up) {
    for (int hour = 1; hour <= 24; ++hour) {
      record.begin_day(day_of(3, day, warm_up), [&] {
        ++asked;
        return std::vector<double>(24, 500.0);
      });
      if (hour == 12) shade(record);
    }
  };
  begin(1, true);
  EXPECT_EQ(asked, 0);
  begin(1, false);
  begin(2, false);
  EXPECT_EQ(asked, 2);
  record.end();
  EXPECT_EQ(record.simulated(), 2U);
  EXPECT_NEAR(beam_of_run(record, 0), 2 * 0.5 * 0.5 * std::cos(60.0 * degree), 1e-6);
}

TEST(RunRecord, LeavesPatchesOfTheSkyOut) {
  auto record = record_of_a_box();
  record.begin_day(day_of(3, 1), beam_of(500.0));
  shade(record);
  record.set_sun({15.0 * degree, 7.5 * degree});
  record.note(0, 0.0);
  record.begin_step({});  // the sky for the whole simulation
  record.set_sun({15.0 * degree, 7.5 * degree});
  record.note(2, 0.0);
  record.end();
  ASSERT_EQ(record.days().size(), 1U);
  EXPECT_NEAR(record.days().front().hours.front().fractions[0], 0.5, 1e-6);
  EXPECT_EQ(record.days().front().hours.front().fractions[2], 1.0F);
}

TEST(RunRecord, HasDesignDaysIfThereIsNothingElse) {
  auto record = record_of_a_box();
  auto sizing = day_of(7, 21);
  sizing.kind = RunDay::Kind::design_day;
  record.begin_day(sizing, beam_of(900.0));
  shade(record);
  record.end();
  EXPECT_TRUE(record.of_design_days());
  EXPECT_EQ(record.days().front().month, 7);
  record.begin_day(day_of(3, 1), beam_of(500.0));
  shade(record);
  record.end();
  EXPECT_FALSE(record.of_design_days());
  EXPECT_EQ(record.days().front().month, 3);
}

// A report of a large model must not take all memory.
TEST(RunRecord, KeepsFewerDaysOfManyReceivers) {
  constexpr std::size_t receivers = 100000;
  std::vector<SurfaceId> all(receivers);
  for (std::size_t i = 0; i < receivers; ++i) all[i] = static_cast<SurfaceId>(i);
  RunRecord record(std::vector<glm::dvec3>(receivers, {0.0, 0.0, 1.0}), all);
  for (int month = 1; month <= 12; ++month) {
    for (int day = 1; day <= 28; day += 9) {
      record.begin_day(day_of(month, day), beam_of(100.0));
      for (int hour = 10; hour <= 14; ++hour) {
        record.begin_step({hour, 1});
        record.set_sun(noon);
      }
    }
  }
  record.end();
  EXPECT_EQ(record.simulated(), 48U);
  EXPECT_LE(record.days().size() * 5 * receivers, std::size_t{1} << 24U);
  EXPECT_GE(record.days().size(), 12U);
  EXPECT_EQ(record.light().size(), receivers);
  EXPECT_EQ(record.light()[0].hours(), 1U);
  EXPECT_GT(beam_of_run(record, 0), 0.0);
}

}  // namespace
}  // namespace gpu_shading::energyplus
