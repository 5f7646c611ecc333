#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gpu_shading/device.h"

namespace gpu_shading {

// How a renderer computes: on which device, and how finely. Renderer's constructor checks the
// values.
struct RendererOptions {
  static constexpr double least_error = 1e-5;
  static constexpr double most_error = 0.1;

  DeviceChoice device;
  // Number of pixels along each side of every receiver's tile, 1 .. DeviceInfo::max_resolution.
  // Empty: it follows from `error`. In both cases, a receiver with fewer than side^2 / 64 pixels,
  // or fewer than 16, gets twice as many along each side, repeatedly, up to 4096.
  std::optional<int> resolution = std::nullopt;
  // Target accuracy, least_error .. most_error: 99 % of sunlit fractions are within this absolute
  // error. The size of a tile follows from it and from the length of the shadow edges in view.
  double error = 1e-3;
  // Otherwise views with few edges are answered exactly, without samples, where that costs less.
  bool samples_only = false;
  // Called with one line when the CPU takes over from an OpenGL device: the first views of each
  // kind are compared with the CPU's, and one was wrong; or the device lacks what the scene needs.
  // Without it, wrong answers throw DeviceError.
  std::function<void(std::string const&)> warn = {};
};

}  // namespace gpu_shading
