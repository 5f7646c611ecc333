#pragma once

#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// What is between the samples of a table.
class Interpolant {
 public:
  Interpolant() = default;
  Interpolant(Interpolant const&) = delete;
  Interpolant& operator=(Interpolant const&) = delete;
  virtual ~Interpolant() = default;

  // By column of the table; may be beyond 0 and 1. 0 where nothing is known.
  virtual std::vector<double> at(SunDirection direction) const = 0;
};

}  // namespace gpu_shading
