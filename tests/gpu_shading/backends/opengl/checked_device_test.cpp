// The answers of a device that is right are never taken for wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>

#include "backends/checked/checked_backend.h"
#include "backends/cpu/cpu_backend.h"
#include "backends/open_backend.h"
#include "geometry/triangulation.h"
#include "render/question_batch.h"
#include "scene/casters.h"
#include "support/caster_kinds.h"
#include "support/room.h"

namespace gpu_shading {
namespace {

// Views of a batch, answered by both.
class Both : public ViewBackend {
 public:
  explicit Both(BackendInput const& input)
      : input_(input), device_(open_backend(input, by_opengl)), cpu_(input) {}

  DeviceInfo const& device() const override { return device_->device(); }
  void add(std::vector<ReceiverView> views) override {
    views_.insert(views_.end(), views.begin(), views.end());
    device_->add(views);
    for (ReceiverView& view : views) view.at_pixels = true;
    cpu_.add(std::move(views));
  }
  std::vector<ViewSums> finish() override {
    std::vector<ViewSums> sums = device_->finish();
    std::vector<ViewSums> const references = cpu_.finish();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (views_[i].cosine < 0.05) continue;
      ViewDifference const found =
          compare(views_[i], sums[i], references[i], input_.scene, input_.transmission);
      worst_ = std::max(worst_, found.severity());
      ++compared_;
    }
    views_.clear();
    return sums;
  }
  void forget() override {
    views_.clear();
    device_->forget();
    cpu_.forget();
  }

  double worst() const { return worst_; }  // in tolerances
  int compared() const { return compared_; }

 private:
  BackendInput input_;
  std::unique_ptr<ViewBackend> device_;
  CpuBackend cpu_;
  std::vector<ReceiverView> views_;
  double worst_ = 0.0;
  int compared_ = 0;
};

class CheckedDevice : public testing::TestWithParam<CasterKind> {};
INSTANTIATE_TEST_SUITE_P(Of, CheckedDevice, testing::ValuesIn(caster_kinds()));

TEST_P(CheckedDevice, DiffersByMuchLessThanTheTolerance) {
  Room room;
  Surface shade{"shade", south_facing(1.4, -0.3, 0.5, 1.1, 1.2)};
  finish(shade, GetParam(), 0);
  room.scene.add(shade);
  std::vector<Lot> const lots = add_lots(room.scene, 60, GetParam());
  Scene const& scene = room.scene;
  std::vector<Mesh> const meshes = triangulate_all(scene);
  Transmission const transmission(scene);
  Casters const casters(scene);
  RendererStatistics statistics;
  Both both({scene, meshes, transmission, statistics});
  // Back ends know tiles by their addresses.
  std::deque<Receivers> all_receivers;
  for (int const resolution : {64, 192, 512}) {
    Receivers& receivers = all_receivers.emplace_back(
        scene, casters, transmission, TileSize::fixed(resolution), both.device().max_resolution);
    QuestionBatch batch({scene, casters, transmission, receivers, both, statistics, true});
    std::vector<Sunlit> answer(1);
    std::vector<Sunlit> inside(20);
    auto const ask = [&](SurfaceId receiver, SunDirection sun,
                         std::vector<SurfaceId> const& interiors) {
      batch.ask({receiver, to_vector(sun), false, {}, answer});
      batch.ask(
          {receiver, to_vector(sun), true, interiors, std::span(inside).first(interiors.size())});
    };
    for (Lot const& lot : lots) {
      for (double const turned : {0.0, 0.2, -0.35}) {
        // What lies behind the receiver's plane is its interior.
        ask(lot.receiver, {lot.sun.azimuth + turned, lot.sun.altitude - turned}, lot.casters);
      }
    }
    for (int const azimuth : {150, 180, 215}) ask(room.window, sun_at(azimuth, 35), room.surfaces);
    batch.finish();
  }
  std::printf("%d views, largest difference %.3f tolerances\n", both.compared(), both.worst());
  EXPECT_GT(both.compared(), 700);
  EXPECT_LT(both.worst(), 0.2);
  EXPECT_GT(both.worst(), 0.0);  // they are two
}

// Through the public interface: nothing warns.
TEST_P(CheckedDevice, IsNotComplainedAbout) {
  Scene scene;
  std::vector<Lot> const lots = add_lots(scene, 30, GetParam());
  RendererOptions options;
  options.device = by_opengl;
  options.samples_only = true;
  options.warn = [](std::string const& line) { ADD_FAILURE() << line; };
  Renderer renderer(scene, options);
  for (Lot const& lot : lots) {
    sunlit(renderer, lot.sun, lot.receiver);
    renderer.interior_sunlit_areas(lot.sun, lot.receiver, lot.casters);
  }
  EXPECT_EQ(renderer.device().id, numbered_device(0));
  EXPECT_GT(renderer.statistics().count_seconds, 0.0);  // they were compared
}

}  // namespace
}  // namespace gpu_shading
