#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "scene/screens.h"
#include "view/outline_spectrum.h"
#include "view/sheet_in_beam.h"
#include "view/view.h"

namespace gpu_shading {

// The frequencies of a screen's holes as a view has them, in cycles per tile.
class HoleSpectrum {
 public:
  HoleSpectrum(Screens::Entry const& screen, SheetInBeam const& sheet, View const& view,
               OutlineSpectrum const& outline);

  // Upper limit of the error of the mean that a vector of a grid's reciprocal lattice causes, by
  // the holes' nearest frequency if that is no more than `within` from it.
  double error_at(glm::dvec2 const& vector, double within) const;

  struct Frequency {
    glm::dvec2 at;
    double amplitude;
  };
  // The lowest of all holes, without those of small amplitude.
  std::vector<Frequency> lowest() const;

 private:
  void describe(PerforatedScreen const& screen, SheetInBeam const& sheet);
  double amplitude(glm::dvec2 const& frequency) const;

  OutlineSpectrum outline_;
  bool staggered_;
  double open_;
  glm::dvec2 tile_;
  glm::dmat2 basis_{1.0};  // of the frequencies of holes
  glm::dmat2 to_index_{1.0};
  double per_area_ = 0.0;          // holes per m2
  double arcs_ = 0.0;              // of a hole
  std::vector<glm::dvec2> sides_;  // one of each two that are parallel
  double highest_ = 0.0;           // frequency that matters, per m, squared
};

}  // namespace gpu_shading
