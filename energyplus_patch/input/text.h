#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// Without the blanks and ends of lines around it.
std::string trimmed(std::string_view text);

// What commas part in a line, each trimmed.
std::vector<std::string> comma_separated(std::string const& line);

// As a field of CSV, whatever it holds.
std::string csv_quoted(std::string_view text);

}  // namespace gpu_shading::energyplus
