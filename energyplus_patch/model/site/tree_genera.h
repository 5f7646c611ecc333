#pragma once

#include <string>
#include <string_view>

namespace gpu_shading::energyplus {

struct TreeGenus {
  std::string_view name;
  // Of leaves and of the wood that they do not hide, over the crown's volume, in m2/m3.
  double density_in_leaf;
  bool evergreen;
};

// That of a genus or a species, as "Tilia cordata"; nullptr if it is not among those measured.
TreeGenus const* find_genus(std::string const& taxon);

// All that are measured, in alphabetical order.
std::string list_genera();

}  // namespace gpu_shading::energyplus
