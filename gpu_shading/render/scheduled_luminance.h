#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <vector>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "render/luminance.h"
#include "render/schedule_keys.h"

namespace gpu_shading {

// Luminance by the keys of the schedules passed, in their order, summed over pixels in double
// precision: as many entries as there are combinations.
using LuminanceByKey = std::map<ScheduleKeys::Sum, double>;

// Sums luminance apart for each combination of schedules passed: red, green and blue of a float
// target take the keys, alpha the luminance; it is read back and sorted on the CPU. For tiles of
// one side.
class ScheduledLuminance {
 public:
  explicit ScheduledLuminance(int side);

  // One answer for each job, in order, from the draw list that `geometry` holds.
  std::vector<LuminanceByKey> sum(Geometry& geometry, std::span<ReceiverJob const> jobs);

 private:
  int side_;
  std::vector<gl::Framebuffer> targets_;
  std::vector<glm::vec4> pixels_;
};

// The same of a window, apart for each interior surface that the sun reaches first behind it. Of
// surfaces in the same place the first takes it.
class InteriorLuminance {
 public:
  explicit InteriorLuminance(int side);

  // One answer for each surface of the job, in order.
  std::vector<LuminanceByKey> sum(Geometry& geometry, InteriorJob const& job);

 private:
  gl::Program program_;
  gl::Framebuffer luminance_;
  gl::Framebuffer nearest_;
};

}  // namespace gpu_shading
