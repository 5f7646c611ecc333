#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// EnergyPlus passes vertices in single precision: 4,000 km from the origin, in the coordinates of
// national grids, it rounds them to 0.25 m. The model gives them in double precision.
class FarOutlines {
 public:
  FarOutlines() = default;
  // Detailed surfaces with coordinates beyond single_precision_reach, without those that are left
  // out of EnergyPlus's input. None where EnergyPlus changes vertices (reason_against_outlines).
  FarOutlines(std::vector<InputObject> const& objects, ShadingInput const& input,
              Names const& left_out);

  // The largest distance of a surface or a zone from the origin, m, along an axis or more.
  double largest() const { return largest_; }

  // Replaces the vertices of a surface of EnergyPlus's by those of the model. Returns false if some
  // could not be found there.
  bool restore(Surface& surface) const;

 private:
  std::map<std::string, Ring> outlines_;                     // by upper-case names
  std::map<std::string, std::vector<std::string>> windows_;  // by base surface, those in outlines_
  double largest_ = 0.0;
};

// The largest absolute coordinate, m.
double largest_coordinate(Polygon const& polygon);

// Half the distance between numbers of single precision, m.
double single_precision_error(double coordinate);

}  // namespace gpu_shading::energyplus
