#include "hidden/daylight_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace gpu_shading::energyplus {
namespace {

using Kind = DaylightMemory::Kind;
DaylightMemory::Points const control{Kind::control, 1};
DaylightMemory::Points const map{Kind::map, 1};

// One timestep with shadows of its own; whether the factors of points are computed.
bool computed(DaylightMemory& memory, int hour, bool sun, DaylightMemory::Points points = control) {
  memory.note_shadows(hour);
  memory.begin(true);
  if (sun) memory.note_sun();
  bool const wanted = memory.begin_points(points, sun);
  memory.end_points();
  return wanted;
}

TEST(DaylightMemory, ComputesFactorsOnceInTheDark) {
  DaylightMemory memory;
  EXPECT_TRUE(computed(memory, 1, false));
  EXPECT_FALSE(computed(memory, 1, false));
  EXPECT_TRUE(computed(memory, 2, false));  // they are kept by hour
  EXPECT_TRUE(computed(memory, 1, false, map));
  EXPECT_FALSE(computed(memory, 2, false));
}

TEST(DaylightMemory, ComputesFactorsAgainAfterTheSunHasSet) {
  DaylightMemory memory;
  for (int const hour : {1, 23, 24}) EXPECT_TRUE(computed(memory, hour, false));
  for (int const hour : {12, 12, 13}) EXPECT_TRUE(computed(memory, hour, true));
  EXPECT_TRUE(computed(memory, 23, false));
  EXPECT_FALSE(computed(memory, 24, false));
  EXPECT_FALSE(computed(memory, 1, false));
  EXPECT_TRUE(computed(memory, 23, true));  // a longer day
  EXPECT_TRUE(computed(memory, 23, false));
}

TEST(DaylightMemory, IsInTheDarkOnlyIfTheWeatherIs) {
  DaylightMemory memory;
  EXPECT_TRUE(computed(memory, 1, false));
  memory.note_shadows(1);
  memory.begin(true);
  EXPECT_TRUE(memory.begin_points(control, true));
  EXPECT_TRUE(computed(memory, 1, false));
}

TEST(DaylightMemory, ComputesFactorsOfWholeDays) {
  DaylightMemory memory;
  for (int day = 0; day < 2; ++day) {
    for (int hour = 1; hour <= 24; ++hour) memory.note_shadows(hour);
    memory.begin(true);
    EXPECT_TRUE(memory.begin_points(control, false));
  }
  // Nothing is known of shadows since the factors were computed.
  EXPECT_TRUE(computed(memory, 1, false));
  memory.begin(true);
  EXPECT_TRUE(memory.begin_points(control, false));
}

TEST(DaylightMemory, KeepsRaysOnlyWhileTheyHold) {
  DaylightMemory memory;
  auto const ray = DaylightMemory::question(DaylightMemory::Ray::in_room, 7, {0, 1, 2}, {3, 4, 5});
  auto const sky =
      DaylightMemory::question(DaylightMemory::Ray::through_window, 7, {0, 1, 2}, {3, 4, 5});
  EXPECT_NE(ray, sky);
  EXPECT_EQ(memory.rays(), nullptr);
  auto const begin = [&](bool hold) {
    memory.begin(hold);
    memory.begin_points(control, true);
    return memory.rays();
  };
  auto* const rays = begin(true);
  ASSERT_NE(rays, nullptr);
  EXPECT_EQ(rays->find(ray), nullptr);
  rays->keep(ray, 0.25);
  ASSERT_NE(begin(true)->find(ray), nullptr);
  EXPECT_EQ(begin(false), nullptr);
  EXPECT_EQ(begin(true)->find(ray), nullptr);
}

// What EnergyPlus's function would return, and how often it is called.
struct Sky {
  int calls = 0;
  std::vector<double> integrate(DaylightMemory& memory, int window) {
    DaylightMemory::SkyOfWindow const sky(memory, 12, window);
    std::vector<double> luminances;
    luminances.reserve(10);
    for (int i = 0; i < 10; ++i) {
      luminances.push_back(memory.luminance(i % 4, 0.1 * i, 0.2 * i, [&] {
        ++calls;
        return 0.5 * i;
      }));
    }
    return luminances;
  }
};

TEST(DaylightMemory, ComputesTheSkyOfAWindowOnce) {
  DaylightMemory memory;
  memory.begin(true);
  Sky sky;
  auto const first = sky.integrate(memory, 1);
  EXPECT_EQ(sky.calls, 10);
  EXPECT_EQ(sky.integrate(memory, 1), first);
  EXPECT_EQ(sky.calls, 11);  // the first one, as a test
  sky.integrate(memory, 2);
  EXPECT_EQ(sky.calls, 21);
  memory.begin(true);
  sky.integrate(memory, 1);
  EXPECT_EQ(sky.calls, 31);
}

TEST(DaylightMemory, KeepsTheSkyOfWindowsThatRecurs) {
  DaylightMemory memory;
  EXPECT_FALSE(memory.sky_recurs(12, 1));
  EXPECT_FALSE(memory.sky_recurs(12, 2));
  EXPECT_FALSE(memory.sky_recurs(13, 1));
  memory.begin(false);
  EXPECT_FALSE(memory.sky_recurs(12, 1));
  EXPECT_TRUE(memory.sky_recurs(12, 1));
  memory.begin(false);
  EXPECT_TRUE(memory.sky_recurs(13, 1));
  EXPECT_FALSE(memory.sky_recurs(13, 2));
}

TEST(DaylightMemory, NoticesAnotherSun) {
  DaylightMemory memory;
  auto const luminance = [&](double value) {
    return memory.luminance(0, 0.0, 0.0, [&] { return value; });
  };
  {
    DaylightMemory::SkyOfWindow const window(memory, 12, 1);
    EXPECT_EQ(luminance(1.0), 1.0);
  }
  {
    DaylightMemory::SkyOfWindow const window(memory, 12, 1);
    EXPECT_EQ(luminance(2.0), 2.0);
  }
  EXPECT_EQ(luminance(3.0), 3.0);  // not for a window
}

TEST(DaylightMemory, ComputesReflectedLightOnceForOneWindow) {
  DaylightMemory memory;
  auto const reflected = [&](int hour, bool first, int window) {
    return memory.begin_reflected({hour, first, 1, window});
  };
  auto const point = [&](int window) {
    int count = 0;
    for (int hour = 8; hour <= 17; ++hour) count += reflected(hour, hour == 8, window) ? 1 : 0;
    return count;
  };
  memory.begin(false);
  EXPECT_EQ(point(1), 10);
  EXPECT_EQ(point(1), 0);
  EXPECT_EQ(point(2), 10);  // EnergyPlus keeps one window's
  EXPECT_EQ(point(1), 10);
  EXPECT_TRUE(memory.begin_reflected({12, false, 2, 1}));  // in another enclosure
  EXPECT_TRUE(reflected(12, false, 1));
  EXPECT_FALSE(reflected(12, false, 1));
  memory.begin(false);
  EXPECT_EQ(point(1), 10);
}

// The obstructions that EnergyPlus keeps are those of another window.
TEST(DaylightMemory, ComputesReflectedLightAgainForOtherObstructions) {
  DaylightMemory memory;
  memory.begin(false);
  EXPECT_TRUE(memory.begin_reflected({12, false, 1, 1}));
  EXPECT_FALSE(memory.begin_reflected({12, false, 1, 1}));
  EXPECT_TRUE(memory.begin_reflected({8, true, 1, 2}));
  EXPECT_TRUE(memory.begin_reflected({12, false, 1, 1}));
  EXPECT_FALSE(memory.begin_reflected({8, true, 1, 2}));
  EXPECT_TRUE(memory.begin_reflected({8, true, 1, 1}));
  EXPECT_TRUE(memory.begin_reflected({8, true, 1, 2}));
}

TEST(DaylightMemory, AlwaysComputesWhatIsAddedToSums) {
  DaylightMemory memory;
  memory.begin(false);
  for (int point = 0; point < 2; ++point) {
    EXPECT_TRUE(memory.begin_reflected({12, false, 1, 1}));
    memory.note_sums();
  }
}

using Sequence = SequenceCache<1>;

// The answer to each question is the question; returns how many were known.
int ask(Sequence& answers, std::vector<std::uint64_t> const& questions) {
  answers.restart();
  int known = 0;
  for (auto const question : questions) {
    if (auto const* const answer = answers.find({question})) {
      EXPECT_EQ(*answer, static_cast<double>(question));
      ++known;
    } else {
      answers.keep({question}, static_cast<double>(question));
    }
  }
  return known;
}

TEST(SequenceCache, AreFoundInTheirOrder) {
  std::size_t room = 100;
  Sequence answers(room);
  EXPECT_EQ(ask(answers, {1, 2, 3, 2, 1}), 0);
  EXPECT_EQ(ask(answers, {1, 2, 3, 2, 1}), 5);
  EXPECT_EQ(ask(answers, {1, 2, 9, 3, 2, 1}), 5);  // one more in between
  EXPECT_EQ(ask(answers, {1, 3, 2, 1}), 4);        // one fewer
  EXPECT_EQ(ask(answers, {1, 2, 3, 2, 1, 4}), 5);  // more behind
  EXPECT_EQ(ask(answers, {1, 2, 3, 2, 1, 4}), 6);
  EXPECT_EQ(room, 94U);
}

TEST(SequenceCache, AreForgottenIfTheyAreOfNoUse) {
  std::size_t room = 100;
  Sequence answers(room);
  EXPECT_EQ(ask(answers, {1, 2, 3}), 0);
  EXPECT_EQ(ask(answers, {4, 5, 6}), 0);
  EXPECT_EQ(ask(answers, {4, 5, 6}), 0);
  EXPECT_EQ(ask(answers, {4, 5, 6}), 3);
}

TEST(SequenceCache, ShareTheirRoom) {
  std::size_t room = 4;
  {
    Sequence few(room);
    Sequence many(room);
    ask(few, {1, 2});
    ask(many, {1, 2, 3});
    EXPECT_EQ(ask(many, {1, 2, 3}), 2);
    EXPECT_EQ(room, 0U);
    few.clear();
    EXPECT_EQ(ask(many, {1, 2, 3}), 2);
    EXPECT_EQ(ask(many, {1, 2, 3}), 3);
  }
  EXPECT_EQ(room, 4U);
}

}  // namespace
}  // namespace gpu_shading::energyplus
