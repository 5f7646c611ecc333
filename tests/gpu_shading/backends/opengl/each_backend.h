#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "support/shapes.h"

namespace gpu_shading {

// Cases that each back end is held to.
class EachBackend : public testing::TestWithParam<DeviceChoice> {
 protected:
  static Renderer renderer_of(Scene scene, int resolution = 512) {
    return gpu_shading::renderer_of(std::move(scene), resolution, GetParam());
  }
};

inline auto const backends = testing::Values(by_opengl, on_cpu);

inline std::string name_of(testing::TestParamInfo<DeviceChoice> const& info) {
  return info.param == by_opengl ? "drawn" : "counted";
}

}  // namespace gpu_shading
