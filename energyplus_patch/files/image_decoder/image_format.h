#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::decoding {

// Whether the fourth byte of a BMP's texels is opacity: only a header of version 3 or later with
// bit fields says so. OpenImageIO takes it for that always, and bit fields for the usual ones;
// throws std::runtime_error if they are others.
bool bmp_has_alpha(char const* path);

// OpenImageIO's name of the format of an image by its first bytes: png, jpeg, tiff, openexr, bmp or
// hdr; "" for any other.
std::string format_by_content(char const* path);

// The same, or targa. A TARGA file begins with no mark, so its name must end in .tga. Throws
// std::runtime_error if the name has no ending of these formats, or the file is in none of them.
std::string restricted_format(char const* path, std::filesystem::path const& name);

}  // namespace gpu_shading::decoding
