#pragma once

#include <string>
#include <string_view>

namespace gpu_shading::energyplus {

// We use UTF-8; Windows uses UTF-16. Invalid characters become U+FFFD.
std::wstring to_wide(std::string_view text);
std::string to_utf8(std::wstring_view text);

}  // namespace gpu_shading::energyplus
