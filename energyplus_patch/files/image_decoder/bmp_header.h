#pragma once

namespace gpu_shading::decoding {

// Whether the fourth byte of a BMP's texels is opacity: only a header of version 3 or later with
// bit fields says so. OpenImageIO takes it for that always, and bit fields for the usual ones;
// throws std::runtime_error if they are others.
bool bmp_has_alpha(char const* path);

}  // namespace gpu_shading::decoding
