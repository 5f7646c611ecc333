#pragma once

#include <string>
#include <variant>
#include <vector>

#include "gpu_shading/sampled_sunlit.h"

// Windows whose sunlit fraction is known in closed form along each of their vertical lines.
// Coordinates as seen from outside, metres: x to the right and z up from the window's lower left
// corner, y out of the wall.
namespace gpu_shading::shaded_window {

// z is above the wall's foot by y times the slope from (near, foot) to (far, head); from left to
// right without end.
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
  double azimuth;  // that it faces, radians
  std::vector<Caster> casters;

  glm::dvec3 normal_times_area() const;
  // Of one square metre's beam: 0 where it is turned away.
  double cosine(SunDirection sun) const;
  double sunlit_fraction(SunDirection sun) const;
};

// One kind of shade, before windows to the south, west-southwest, east and north.
struct Scene {
  std::string name;
  double wanted_mean;  // largest mean error of the sunlit fraction at medium density
  double wanted_beam;  // and of the beam
  std::vector<Window> windows;
};

std::vector<Scene> const& scenes();

// In place of a renderer. `factor`: number of a schedule that all shadows let their whole beam
// through by, or -1.
SunlitSource source_of(std::vector<Window> const& windows, int schedule = -1);

std::vector<glm::dvec3> receivers_of(std::vector<Window> const& windows);

// The sun at every quarter of an hour of one day in `every` of a year of sun_of_day.
std::vector<SunDirection> year_of_suns(double latitude, int every);

struct Errors {
  double mean = 0.0;  // |sunlit fraction|, while the sun faces the window; mean over windows
  double largest = 0.0;
  // Of the year's beam, of a sun that is always as strong; largest of the windows that get at least
  // a tenth of what the best gets.
  double beam = 0.0;
};

Errors errors_of(SampledSunlit const& sampled, std::vector<Window> const& windows,
                 std::vector<SunDirection> const& suns);

}  // namespace gpu_shading::shaded_window
