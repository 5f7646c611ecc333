#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::decoding {

// OpenImageIO's name of the format of an image by its first bytes: png, jpeg, tiff, openexr, bmp or
// hdr; "" for any other.
std::string format_by_content(char const* path);

// The same, or targa. A TARGA file begins with no mark, so its name must end in .tga. Throws
// std::runtime_error if the name has no ending of these formats, or the file is in none of them.
std::string restricted_format(char const* path, std::filesystem::path const& name);

}  // namespace gpu_shading::decoding
