#pragma once

#include <string>
#include <string_view>

namespace gpu_shading::energyplus {

// Text of ours is UTF-8, Windows's own is UTF-16. What is neither becomes U+FFFD.
std::wstring to_wide(std::string_view text);
std::string to_utf8(std::wstring_view text);

}  // namespace gpu_shading::energyplus
