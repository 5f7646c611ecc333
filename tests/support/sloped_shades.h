#pragma once

#include <array>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// A receiver that faces south behind shades parallel to it, whose edges have one slope in its plane
// at each direction of the sun.
struct SlopedShades {
  enum class Receiver { wide, narrow, square, triangle, octagon, with_hole };
  enum class Shade { edge, gable, slats };
  enum class Beam { opaque, glass, scheduled, screen };

  static constexpr std::array receivers{Receiver::wide,     Receiver::narrow,  Receiver::square,
                                        Receiver::triangle, Receiver::octagon, Receiver::with_hole};
  static constexpr std::array shades{Shade::edge, Shade::gable, Shade::slats};
  // All but screens have exact answers where edges are few.
  static constexpr std::array beams{Beam::opaque, Beam::glass, Beam::scheduled, Beam::screen};

  Receiver receiver = Receiver::wide;
  Shade shade = Shade::edge;
  Beam beam = Beam::opaque;
  double pitch = 0.0;  // of the edges, from the horizontal, in degrees; of a gable above 0

  // Receiver 0, then the shades; a schedule is number 0.
  Scene scene() const;

  static char const* name(Shade shade);
  static char const* name(Beam beam);
};

// Directions at which the receiver faces the sun and sees edges, spread evenly.
std::vector<SunDirection> suns_over_edges(int count);

// Errors of sunlit fractions, against exact polygons.
class SlopeErrors {
 public:
  // Over directions, with schedules at 0.5. `samples_only`: see RendererOptions.
  void add(SlopedShades const& shades, std::vector<SunDirection> const& suns, double target,
           bool samples_only);

  std::size_t count() const { return errors_.size(); }
  double most() const;
  // The share of errors that are larger.
  double beyond(double error) const;

 private:
  std::vector<double> errors_;
};

}  // namespace gpu_shading
