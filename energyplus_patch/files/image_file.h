#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "files/asset_folder.h"
#include "files/image_decoder/elevations.h"

namespace gpu_shading::energyplus {

// An image as displayed: turned as its EXIF orientation says, and all of its display window.
struct TextureInfo {
  int width = 0;  // texels
  int height = 0;
  int channels = 0;
  bool alpha = false;
  std::vector<std::uint16_t> opacity;  // of a small image; otherwise empty: see read_opacity()
};

// Tiles with more texels per side are refused.
inline constexpr int max_texture_side = 16384;

// Reads the header, which is all that is read. Throws Error, "FILE: why" in one line, if the file
// is missing, not an image that `assets` permits, or too large.
TextureInfo probe_texture(std::filesystem::path const& path, Assets assets = Assets::restricted);

// Opacity of each texel, 0 (open) .. 65535 (solid): alpha if the image has it, otherwise luminance
// as stored (weights of Rec. 709 for three channels or more, otherwise the first channel). Rows
// from the bottom, because a tile's v points up. Throws the same errors, and if the image cannot be
// read completely or a texel is NaN.
std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path, TextureInfo const& info,
                                        Assets assets = Assets::restricted);

// Reads a GeoTIFF: its header, and its elevations in metres with rows as in the file, NaN where it
// has no data; none if there are more than max_elevations. Throws Error with the reason in one
// line, to which the caller adds the file's name.
decoding::Elevations read_elevations(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
