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

// Opens devices one after the other, each with a context, so that no more are opened than needed.
// Order and indices are those of list_devices().
class DeviceWalk {
 public:
  DeviceWalk();

  // The next device, empty at the end.
  std::optional<Device> next();
  // One line for each device that could not be opened so far.
  std::vector<std::string> const& failures() const { return failures_; }

 private:
  bool is_known(std::string const& renderer) const;

  std::vector<std::string> failures_;
  std::vector<Display> displays_;
  std::size_t at_ = 0;
  std::vector<std::string> renderers_;
};

// The first GPU; nothing where there is none.
std::optional<Device> open_gpu();

// The one of this index in list_devices(). Throws DeviceError: there is none, with why.
Device open_device(int index);

}  // namespace gpu_shading::egl
