#pragma once

#include <string>
#include <vector>

#include "gpu_shading/device.h"

namespace gpu_shading {

// A device's answers to cases whose sunlit areas have a closed form.
struct DeviceTest {
  // The largest error of a sunlit fraction that counts as right: four times the error that 99 % of
  // views keep to (RendererOptions::error).
  static constexpr double tolerance = 4e-3;

  // Cases of one kind of view.
  struct Kind {
    std::string name;
    double error = 0.0;         // largest, of the sunlit fraction; may not be a number
    double milliseconds = 0.0;  // per view

    bool right() const { return error <= tolerance; }
  };

  DeviceInfo device;
  std::vector<Kind> kinds;
  std::string failure;  // why the device could not be tested; empty if it was

  bool right() const;
  double milliseconds() const;  // of one view of each kind
};

// Takes some seconds.
DeviceTest test_device(DeviceInfo const& device);

}  // namespace gpu_shading
