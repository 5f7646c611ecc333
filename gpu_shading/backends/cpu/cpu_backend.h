#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "backends/cpu/coverage.h"
#include "backends/interface/view_backend.h"
#include "filters/transmission.h"

namespace gpu_shading {

// Rasterises views on the CPU, on all its cores.
class CpuBackend : public ViewBackend {
 public:
  // Adds to the statistics' seconds of counting.
  explicit CpuBackend(BackendInput const& input);

  DeviceInfo const& device() const override { return device_; }
  bool samples_pixels() const override { return false; }
  std::optional<std::size_t> few_casters(bool /*interiors*/) const override { return 4000; }

  // Throws Error where a view has too many combinations of schedules.
  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override { sums_.clear(); }

 private:
  // The screens in front of a view.
  struct ViewScreens {
    std::vector<int> numbers;
    std::size_t direction = 0;  // where there are any
  };

  ViewScreens note_screens(ReceiverView const& view, std::vector<ScreensAtDirection>& directions);
  ViewSums sums_of(ReceiverView const& view, ScreensInView const& screens, int threads);
  // Once.
  ViewSums sampled(ReceiverView const& view, CastersInView const& casters, int threads) const;
  // By samples whose error is measured.
  ViewSums measured(ReceiverView const& view, CastersInView const& casters, int threads) const;
  // The receiver, in columns and rows, or its bounding rectangle.
  std::vector<ConvexArea> outline(ReceiverView const& view, TileMap const& map,
                                  TileGrid const& grid, bool as_rectangle) const;

  DeviceInfo device_;
  Scene const& scene_;
  Coverage coverage_;
  std::optional<CrowdRaster> crowd_;  // once there is one
  LitCrowds lit_crowds_;
  Transmission const& transmission_;
  RendererStatistics& statistics_;
  std::vector<ViewSums> sums_;
};

}  // namespace gpu_shading
