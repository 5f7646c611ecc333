#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gpu_shading::energyplus {

// A string's characters; other values as JSON.
inline std::string text_of(nlohmann::json const& value) {
  constexpr auto replace = nlohmann::json::error_handler_t::replace;
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, replace);
}

}  // namespace gpu_shading::energyplus
