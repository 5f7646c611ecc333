#pragma once

#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// A receiver that faces south, behind equal blades at equal distances. They reach so far beyond it
// that their ends never shade it, and its sunlit fraction follows from their edges alone.
struct RegularShades {
  int count = 1;
  bool upright = false;  // fins, which divide the width; otherwise louvres, which divide the height
  double size = 3.0;     // width of the receiver, m; its height is 0.7 of it
  double transmittance = 0.0;

  double width() const { return size; }
  double height() const { return 0.7 * size; }

  // The receiver, then the blades.
  Scene scene() const;
  // The exact sunlit fraction: lengths of intervals. The receiver must face the sun.
  double sunlit_fraction(SunDirection sun) const;

 private:
  double pitch() const { return (upright ? width() : height()) / count; }
};

// Directions at which the receiver faces the sun, spread evenly.
std::vector<SunDirection> spread_suns(int count);

// Numbers of blades from `least` to `most`, in steps of at most `step`, with all powers of two and,
// if wanted, all multiples of a hundred.
std::vector<int> blade_counts(int least, int most, double step, bool hundreds);

}  // namespace gpu_shading
