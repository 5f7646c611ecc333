#pragma once

#include <optional>
#include <string>

namespace gpu_shading::energyplus {

// A field's number; nothing where the text is not one, whole.
std::optional<double> parse_number(std::string const& text);

}  // namespace gpu_shading::energyplus
