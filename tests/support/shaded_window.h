#pragma once

#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "gpu_shading/sampled_sunlit.h"

// Windows and skylights whose sunlit fraction has a closed form along each line of equal x.
// Coordinates as seen from outside, metres: x to the right and z up from the lower left corner in
// the plane of the glass, y out of it. A skylight whose foot is in the south has x to the east and
// z to the north.
namespace gpu_shading::shaded_window {

// z follows the line from (near, foot) to (far, head) in y; from left to right without end.
struct Blade {
  double near;
  double near_z;
  double far;
  double far_z;
};
struct Overhang {
  double z;
  double depth;
  double left;
  double right;
};
struct Fin {
  double x;
  double depth;
  double bottom;
  double top;
};
// Parallel to the wall.
struct Rectangle {
  double distance;
  double left;
  double right;
  double bottom;
  double top;
};
using Caster = std::variant<Blade, Overhang, Fin, Rectangle>;

struct Window {
  double width;
  double height;
  double azimuth;  // azimuth that it faces, radians
  std::vector<Caster> casters;
  double tilt = std::numbers::pi / 2.0;  // radians; 0: a skylight, whose foot is towards `azimuth`

  glm::dvec3 normal_times_area() const;
  // Beam per square metre; 0 if it faces away.
  double cosine(SunDirection sun) const;
  double sunlit_fraction(SunDirection sun) const;
};

// One kind of shade, in front of windows facing south, west-southwest, east and north, or over
// skylights whose sides face south and southwest.
struct Scene {
  std::string name;
  double wanted_mean;  // largest mean error of a window's sunlit fraction at medium density
  double wanted_beam;  // and of the beam
  std::vector<Window> windows;
};

std::vector<Scene> const& scenes();

// Replaces a renderer. `factor`: index of a schedule through which all shadows transmit the whole
// beam, or -1.
SunlitSource source_of(std::vector<Window> const& windows, int schedule = -1);

std::vector<glm::dvec3> receivers_of(std::vector<Window> const& windows);

// The sun at every quarter of an hour of one day in `every` of a year of sun_of_day.
std::vector<SunDirection> year_of_suns(double latitude, int every);

struct Errors {
  double mean = 0.0;   // |sunlit fraction|, while the sun faces the window; mean over windows
  double worst = 0.0;  // largest mean of a window
  double largest = 0.0;
  // Error of the year's beam, for a sun of constant strength: the largest of the windows that get
  // at least a tenth of the beam of the best.
  double beam = 0.0;
};

Errors errors_of(SampledSunlit const& sampled, std::vector<Window> const& windows,
                 std::vector<SunDirection> const& suns);

}  // namespace gpu_shading::shaded_window
