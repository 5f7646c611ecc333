#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gpu_shading::energyplus {

// An image file as OpenImageIO sees it by its header, which is all that is read.
struct TextureInfo {
  int width = 0;  // texels
  int height = 0;
  int channels = 0;
  bool alpha = false;
};

// A tile of more texels a side is refused.
inline constexpr int max_texture_side = 16384;

// Throws Error: "FILE: why", one line, where the file is missing, no image or too large.
TextureInfo probe_texture(std::filesystem::path const& path);

// Opacity of each texel, 0 open .. 65535 solid: alpha where the image has it, else luminance as
// stored (weights of Rec. 709 for three channels or more, else the first channel). Rows from the
// bottom, as a tile's v runs up. Throws Error likewise, and where the image cannot be read to its
// end or a texel is not a number.
std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path, TextureInfo const& info);

}  // namespace gpu_shading::energyplus
