#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "egl/context.h"
#include "gpu_shading/device.h"

namespace gpu_shading::egl {

struct Device {
  Context context;
  DeviceInfo info;
};

// Devices one after the other, each with a context opened on it, so that no more are opened than
// needed. The order and the indices are those of list_devices().
class DeviceWalk {
 public:
  DeviceWalk();

  // Nothing at the end.
  std::optional<Device> next();
  // A line for each that could not be opened so far.
  std::vector<std::string> const& failures() const { return failures_; }

 private:
  bool is_known(std::string const& renderer) const;

  std::vector<std::string> failures_;
  std::vector<Display> displays_;
  std::size_t at_ = 0;
  std::vector<std::string> renderers_;
};

// Throws DeviceError: nothing of that kind, with why.
Device open_device(DeviceChoice const& choice);

}  // namespace gpu_shading::egl
