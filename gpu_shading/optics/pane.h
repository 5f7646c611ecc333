#pragma once

#include <array>
#include <variant>

#include "gpu_shading/transmittance.h"

namespace gpu_shading {

// Coefficients over the cosine of the angle of incidence, from its power 0.
using Quartic = std::array<double, 5>;

// The value of an angular regression, made to meet 1 at normal incidence and `at_grazing`, both of
// which it misses by up to 0.02. EnergyPlus evaluates regressions at steps of 10 degrees and puts
// these ends for the first and the last; here what is missing comes in over the last 10 degrees to
// either end, with the square of the cosine's way there, so that there is no kink.
double normalised(Quartic const& curve, double cosine, double at_grazing);

// What one pane does at an angle.
struct PaneProperties {
  double transmittance = 0.0;
  double front_reflectance = 0.0;
  double back_reflectance = 0.0;
};

// A pane over the angle of incidence, from its properties at normal incidence.
class Pane {
 public:
  explicit Pane(GlassLayer const& layer);

  PaneProperties at(double cosine) const;

 private:
  // Clear or tinted glass: refractive index and what one passage straight through it keeps.
  struct Uncoated {
    double index = 1.0;
    double passage = 1.0;
  };
  struct Coated {
    Quartic const* transmittance = nullptr;
    Quartic const* reflectance = nullptr;  // plus transmittance
  };
  struct Opaque {};

  PaneProperties properties(Uncoated const& glass, double cosine) const;
  PaneProperties properties(Coated const& glass, double cosine) const;
  PaneProperties properties(Opaque glass, double cosine) const;

  GlassLayer normal_;
  std::variant<Opaque, Uncoated, Coated> kind_;
};

}  // namespace gpu_shading
