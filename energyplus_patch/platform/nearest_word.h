#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// "; did you mean WORD?" for the word that `text` is most probably a mistyping of: the one that the
// fewest inserted, deleted, replaced or swapped letters make of it. Empty where none is near.
std::string did_you_mean(std::string_view text, std::vector<std::string> const& words);

}  // namespace gpu_shading::energyplus
