#pragma once

#include <string>

namespace gpu_shading::energyplus {

// The text with what is not UTF-8, as names in IDF files may be, replaced by U+FFFD.
std::string valid_utf8(std::string const& text);

// Text for HTML, XML and SVG, between tags or in double quotes: valid UTF-8, with & < > " as
// entities, and ? for control characters, which XML does not allow.
std::string markup_text(std::string const& text);

}  // namespace gpu_shading::energyplus
