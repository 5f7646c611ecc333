#pragma once

#include <memory>
#include <vector>

#include "backends/interface/view_backend.h"

namespace gpu_shading {

// A device that draws small holes of perforated sheets by their effective transmittance, which says
// nothing of how the holes of two sheets meet: views where a ray may pass two of them are left to
// the CPU, which draws holes of any size there.
class SheetPairsOnCpu : public ViewBackend {
 public:
  SheetPairsOnCpu(std::unique_ptr<ViewBackend> device, std::unique_ptr<ViewBackend> cpu,
                  Transmission const& transmission);

  DeviceInfo const& device() const override { return device_->device(); }
  bool samples_pixels() const override { return device_->samples_pixels(); }

  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override;

 private:
  bool passes_two(ReceiverView const& view) const;

  std::unique_ptr<ViewBackend> device_;
  std::unique_ptr<ViewBackend> cpu_;
  Transmission const& transmission_;
  std::vector<char> on_cpu_;  // of each view of this batch
};

}  // namespace gpu_shading
