#pragma once

#include <array>
#include <variant>

#include "gpu_shading/transmittance.h"

namespace gpu_shading {

// Coefficients of a polynomial in the cosine of the angle of incidence, from power 0.
using Quartic = std::array<double, 5>;

// The value of an angular regression, corrected to 1 at normal incidence and to `at_grazing`, which
// it misses by up to 0.02. EnergyPlus evaluates regressions in steps of 10 degrees and replaces the
// first and last values by these; here the correction is blended in over the last 10 degrees at
// either end, with the square of the relative cosine, so that there is no kink.
double normalised(Quartic const& curve, double cosine, double at_grazing);

// Properties of one pane at an angle.
struct PaneProperties {
  double transmittance = 0.0;
  double front_reflectance = 0.0;
  double back_reflectance = 0.0;
};

// A pane at any angle of incidence, from its properties at normal incidence.
class Pane {
 public:
  explicit Pane(GlassLayer const& layer);

  PaneProperties at(double cosine) const;

 private:
  // Clear or tinted glass: refractive index and internal transmittance of one perpendicular
  // passage.
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
