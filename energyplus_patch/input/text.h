#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// Without the blanks and ends of lines around it.
std::string trimmed(std::string_view text);

// What commas part in a line, each trimmed.
std::vector<std::string> comma_separated(std::string const& line);

}  // namespace gpu_shading::energyplus
