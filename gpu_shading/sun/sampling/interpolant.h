#pragma once

#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// Interpolation between the samples of a table.
class Interpolant {
 public:
  Interpolant() = default;
  Interpolant(Interpolant const&) = delete;
  Interpolant& operator=(Interpolant const&) = delete;
  virtual ~Interpolant() = default;

  // Values by column of the table, which may be outside 0 .. 1; 0 if nothing is known.
  virtual std::vector<double> at(SunDirection direction) const = 0;
};

}  // namespace gpu_shading
