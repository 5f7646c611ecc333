#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gpu_shading::energyplus {

// An image file as described by its header, which is all that is read.
struct TextureInfo {
  int width = 0;  // texels
  int height = 0;
  int channels = 0;
  bool alpha = false;
};

// Tiles with more texels per side are refused.
inline constexpr int max_texture_side = 16384;

// Throws Error, "FILE: why" in one line, if the file is missing, not an image, or too large.
TextureInfo probe_texture(std::filesystem::path const& path);

// Opacity of each texel, 0 (open) .. 65535 (solid): alpha if the image has it, otherwise luminance
// as stored (weights of Rec. 709 for three channels or more, otherwise the first channel). Rows
// from the bottom, because a tile's v points up. Throws the same errors, and if the image cannot be
// read completely or a texel is NaN.
std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path, TextureInfo const& info);

}  // namespace gpu_shading::energyplus
