#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "backends/opengl/egl/context.h"
#include "gpu_shading/device.h"

namespace gpu_shading::egl {

struct Device {
  Context context;
  DeviceInfo info;
};

// Opens devices one after the other, each with a context, so that no more are opened than needed.
// Order and numbers are those of list_devices().
class DeviceWalk {
 public:
  explicit DeviceWalk(bool debug = false);

  // The next device, empty at the end.
  std::optional<Device> next();
  // One line for each device that could not be opened so far.
  std::vector<std::string> const& failures() const { return failures_; }

 private:
  bool is_known(std::string const& renderer) const;

  bool debug_;
  std::vector<std::string> failures_;
  std::vector<Display> displays_;
  std::size_t at_ = 0;
  std::vector<std::string> renderers_;
};

// The chosen device, or else the first GPU; nothing if there is none. Throws DeviceError, with the
// reason, if there is no device of that number.
std::optional<Device> open(DeviceChoice const& choice);

}  // namespace gpu_shading::egl
