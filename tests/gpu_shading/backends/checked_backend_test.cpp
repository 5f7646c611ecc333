// A device that answers wrongly is found out, whatever kind of view it gets wrong.

#include "backends/checked/checked_backend.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "backends/cpu/cpu_backend.h"
#include "geometry/triangulation.h"
#include "gpu_shading/error.h"
#include "render/question_batch.h"
#include "scene/casters.h"
#include "support/caster_kinds.h"
#include "support/room.h"

namespace gpu_shading {
namespace {

using Spoil = std::function<void(ReceiverView const&, ViewSums&)>;

// Plays a GPU: answers as the CPU does, but spoilt.
class FakeGpu : public ViewBackend {
 public:
  FakeGpu(BackendInput const& input, Spoil spoil) : cpu_(input), spoil_(std::move(spoil)) {
    info_.id = numbered_device(0);
    info_.renderer = "Fake GPU";
    info_.version = "1.0";
    info_.max_resolution = 32768;
  }

  DeviceInfo const& device() const override { return info_; }
  void add(std::vector<ReceiverView> views) override {
    views_.insert(views_.end(), views.begin(), views.end());
    for (ReceiverView& view : views) view.at_pixels = true;
    cpu_.add(std::move(views));
  }
  std::vector<ViewSums> finish() override {
    std::vector<ViewSums> sums = cpu_.finish();
    for (std::size_t i = 0; i < sums.size(); ++i) spoil_(views_[i], sums[i]);
    views_.clear();
    return sums;
  }
  void forget() override {
    views_.clear();
    cpu_.forget();
  }

 private:
  DeviceInfo info_;
  CpuBackend cpu_;
  Spoil spoil_;
  std::vector<ReceiverView> views_;
};

// Answers questions about a scene by some back end.
class Rig {
 public:
  explicit Rig(Scene scene, int resolution = 128)
      : scene_(std::move(scene)),
        casters_(scene_),
        transmission_(scene_),
        meshes_(triangulate_all(scene_)),
        receivers_(scene_, casters_, transmission_, TileSize::fixed(resolution), 4096) {}

  BackendInput input() { return {scene_, meshes_, transmission_, statistics_}; }
  using Keep = CheckedBackend::Keep;
  std::unique_ptr<CheckedBackend> checked(Spoil spoil, Warn warn, Keep keep = Keep::if_right) {
    return std::make_unique<CheckedBackend>(std::make_unique<FakeGpu>(input(), std::move(spoil)),
                                            std::make_unique<CpuBackend>(input()), input(),
                                            std::move(warn), keep);
  }

  std::vector<Sunlit> areas(ViewBackend& backend, std::vector<SunDirection> const& suns) {
    return ask(backend, suns, {});
  }
  // Through surface 0, if there are interiors.
  std::vector<Sunlit> ask(ViewBackend& backend, std::vector<SunDirection> const& suns,
                          std::vector<SurfaceId> const& interiors) {
    std::size_t const parts = std::max<std::size_t>(interiors.size(), 1);
    std::vector<Sunlit> answers(suns.size() * parts);
    QuestionBatch batch({scene_, casters_, transmission_, receivers_, backend, statistics_, true});
    for (std::size_t i = 0; i < suns.size(); ++i) {
      batch.ask({0, to_vector(suns[i]), !interiors.empty(), interiors,
                 std::span(answers).subspan(i * parts, parts)});
    }
    batch.finish();
    return answers;
  }

 private:
  Scene scene_;
  Casters casters_;
  Transmission transmission_;
  std::vector<Mesh> meshes_;
  RendererStatistics statistics_;
  Receivers receivers_;
};

void keep_right(ReceiverView const& /*view*/, ViewSums& /*sums*/) {}

void scale(ViewSums& sums, double factor) {
  for (LuminanceSums& part : sums.parts) {
    part.unscheduled *= factor;
    for (LuminanceSums::Scheduled& scheduled : part.scheduled) scheduled.sum *= factor;
  }
}

void expect_equal(std::vector<Sunlit> const& a, std::vector<Sunlit> const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].projected_area, b[i].projected_area);
    ASSERT_EQ(a[i].scheduled.size(), b[i].scheduled.size());
    for (std::size_t k = 0; k < a[i].scheduled.size(); ++k) {
      EXPECT_EQ(a[i].scheduled[k].projected_area, b[i].scheduled[k].projected_area);
    }
  }
}

// A room whose window has casters of a kind before it.
struct ShadedRoom : Room {
  explicit ShadedRoom(CasterKind const& kind) {
    Surface shade{"shade", south_facing(1.4, -0.3, 0.5, 1.1, 1.2)};
    finish(shade, kind, 0);
    scene.add(shade);
  }
};

std::vector<SunDirection> const suns{sun_at(150, 20), sun_at(165, 40), sun_at(180, 30),
                                     sun_at(190, 55), sun_at(200, 25), sun_at(215, 35)};

// Questions of one kind of view: about a window, or about the room behind it.
struct Asked {
  CasterKind kind;
  bool inside;
};

std::vector<Sunlit> ask(Rig& rig, ViewBackend& backend, Asked const& asked) {
  return rig.ask(backend, suns, asked.inside ? Room().surfaces : std::vector<SurfaceId>());
}

class EachKind : public testing::TestWithParam<std::tuple<CasterKind, bool>> {
 protected:
  Asked asked() const { return {std::get<0>(GetParam()), std::get<1>(GetParam())}; }
};
INSTANTIATE_TEST_SUITE_P(Of, EachKind,
                         testing::Combine(testing::ValuesIn(caster_kinds()), testing::Bool()));

TEST_P(EachKind, OfWrongAnswersIsCaughtAndAnsweredByTheCpu) {
  Rig rig(ShadedRoom(asked().kind).scene);
  CpuBackend cpu(rig.input());
  auto const expected = ask(rig, cpu, asked());
  for (double const factor : {0.0, 0.5, 1.2, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<std::string> warnings;
    auto const checked =
        rig.checked([&](ReceiverView const&, ViewSums& sums) { scale(sums, factor); },
                    [&](std::string const& line) { warnings.push_back(line); });
    EXPECT_EQ(checked->device().renderer, "Fake GPU");
    for (int i = 0; i < 2; ++i) expect_equal(ask(rig, *checked, asked()), expected);
    ASSERT_EQ(warnings.size(), 1U) << factor;
    EXPECT_EQ(warnings[0].find("Fake GPU (1.0) computes wrong answers: the sunlit fraction of "),
              0U)
        << warnings[0];
    EXPECT_EQ(warnings[0].find('\n'), std::string::npos);
    EXPECT_TRUE(checked->device().id.is_cpu());
  }
}

TEST_P(EachKind, OfRightAnswersIsAccepted) {
  Rig rig(ShadedRoom(asked().kind).scene);
  FakeGpu right(rig.input(), keep_right);
  auto const checked = rig.checked(keep_right, [](std::string const& line) { FAIL() << line; });
  for (int i = 0; i < 40; ++i) {
    expect_equal(ask(rig, *checked, asked()), ask(rig, right, asked()));
  }
  EXPECT_EQ(checked->device().renderer, "Fake GPU");
}

TEST_P(EachKind, OfADeviceThatDrawsNothingIsCaught) {
  Rig rig(ShadedRoom(asked().kind).scene);
  CpuBackend cpu(rig.input());
  std::vector<std::string> warnings;
  auto const checked = rig.checked(
      [](ReceiverView const&, ViewSums& sums) {
        sums.receiver_pixels = 0;
        scale(sums, 0.0);
      },
      [&](std::string const& line) { warnings.push_back(line); });
  expect_equal(ask(rig, *checked, asked()), ask(rig, cpu, asked()));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("the size of window"), std::string::npos) << warnings[0];
}

// A kind of view that comes late is checked when it comes; what was found right before stays.
TEST(CheckedBackend, ChecksEachKindWhenItComes) {
  Rig rig(ShadedRoom(caster_kind("scheduled")).scene);
  std::vector<std::string> warnings;
  auto const checked = rig.checked(
      [](ReceiverView const& view, ViewSums& sums) {
        if (view.through) scale(sums, 0.9);
      },
      [&](std::string const& line) { warnings.push_back(line); });
  for (int i = 0; i < 10; ++i) ask(rig, *checked, {caster_kind("scheduled"), false});
  EXPECT_TRUE(warnings.empty());
  ask(rig, *checked, {caster_kind("scheduled"), true});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("an interior behind transmittance schedules"), std::string::npos)
      << warnings[0];
}

// Wrong in one view of many: views are chosen all over the batch, and all of the batch is answered
// again.
TEST(CheckedBackend, LooksAllOverABatch) {
  Rig rig(ShadedRoom(caster_kind("opaque")).scene);
  CpuBackend cpu(rig.input());
  std::vector<SunDirection> many;
  many.reserve(400);
  for (int i = 0; i < 400; ++i) many.push_back(sun_at(140 + 0.2 * i, 35));
  std::vector<std::string> warnings;
  auto const checked = rig.checked(
      [](ReceiverView const& view, ViewSums& sums) {
        if (view.towards_sun.x > 0.3) scale(sums, 0.5);
      },
      [&](std::string const& line) { warnings.push_back(line); });
  expect_equal(rig.areas(*checked, many), rig.areas(cpu, many));
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(CheckedBackend, StopsCountingTwiceSoon) {
  Rig rig(ShadedRoom(caster_kind("opaque")).scene);
  std::size_t wrong_from = 0;
  std::size_t answered = 0;
  auto const checked = rig.checked(
      [&](ReceiverView const&, ViewSums& sums) {
        if (++answered > wrong_from) scale(sums, 0.0);
      },
      [](std::string const& line) { FAIL() << line; });
  wrong_from = 4 * suns.size();
  for (int i = 0; i < 10; ++i) rig.areas(*checked, suns);
  EXPECT_EQ(checked->device().renderer, "Fake GPU");
}

TEST(CheckedBackend, ThrowsWithoutAWayToWarn) {
  Rig rig(ShadedRoom(caster_kind("opaque")).scene);
  auto const checked =
      rig.checked([](ReceiverView const&, ViewSums& sums) { scale(sums, 0.5); }, {});
  EXPECT_THROW(rig.areas(*checked, suns), DeviceError);
}

// Unless it was chosen by name, or nobody can be told.
TEST(CheckedBackend, LeavesADeviceThatIsSlower) {
  Rig rig(ShadedRoom(caster_kind("opaque")).scene);
  auto const slowly = [](ReceiverView const&, ViewSums&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  };
  using Keep = CheckedBackend::Keep;
  std::size_t const batches = CheckedBackend::timed_views / suns.size() + 2;
  for (Keep const keep : {Keep::if_right, Keep::if_right_and_not_slower}) {
    std::vector<std::string> warnings;
    auto const checked = rig.checked(
        slowly, [&](std::string const& line) { warnings.push_back(line); }, keep);
    for (std::size_t i = 0; i < batches; ++i) rig.areas(*checked, suns);
    bool const leaves = keep == Keep::if_right_and_not_slower;
    EXPECT_EQ(checked->device().id.is_cpu(), leaves);
    ASSERT_EQ(warnings.size(), leaves ? 1U : 0U);
    if (leaves) {
      EXPECT_NE(warnings[0].find(" times as long as the CPU"), std::string::npos) << warnings[0];
    }
  }
  auto const silent = rig.checked(slowly, {}, Keep::if_right_and_not_slower);
  for (std::size_t i = 0; i < batches; ++i) rig.areas(*silent, suns);
  EXPECT_FALSE(silent->device().id.is_cpu());
}

// The number of pixels by which a device may differ, and by which not.
TEST(CheckedBackend, ToleratesWhatRoundingMoves) {
  for (int const resolution : {64, 512, 2048}) {
    // Edges of window and shade: about 7 sides of the tile.
    double const edges = 7.0 * resolution;
    Rig rig(ShadedRoom(caster_kind("opaque")).scene, resolution);
    for (double const part : {0.5, 2.0}) {
      bool caught = false;
      auto const checked = rig.checked(
          [&](ReceiverView const&, ViewSums& sums) {
            sums.parts.front().unscheduled += part * std::sqrt(edges);
          },
          [&](std::string const&) { caught = true; });
      rig.areas(*checked, suns);
      EXPECT_EQ(caught, part > 1.0) << resolution;
    }
  }
}

TEST(CheckedBackend, TakesTilesThatSuitBoth) {
  Rig rig(Room().scene);
  auto const checked = rig.checked(keep_right, {});
  EXPECT_EQ(checked->device().max_resolution, cpu_device().max_resolution);
}

}  // namespace
}  // namespace gpu_shading
