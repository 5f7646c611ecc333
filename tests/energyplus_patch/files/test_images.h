#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

// Image files that tests write.
#include "platform/process.h"

namespace gpu_shading::energyplus {

// In a folder of this process alone, since ctest runs tests side by side.
inline std::filesystem::path temporary(std::string const& name) {
  static TemporaryFolder const folder;
  return folder.path() / name;
}

// Rows from the top, channels of a texel together; written in `format`, in tiles where `tile` > 0.
inline std::filesystem::path write_texture(std::string const& name, int width, int height,
                                           int channels, std::vector<float> const& values,
                                           OIIO::TypeDesc const& format = OIIO::TypeDesc::UINT8,
                                           int tile = 0) {
  auto path = temporary(name);
  OIIO::ImageSpec spec(width, height, channels, format);
  spec.tile_width = tile;
  spec.tile_height = tile;
  auto const output = OIIO::ImageOutput::create(path.string());
  EXPECT_TRUE(output && output->open(path.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close())
      << OIIO::geterror();
  return path;
}

// Enough of a picture that half a file holds half of it.
inline std::vector<float> noise(int width, int height, int channels) {
  std::vector<float> values;
  unsigned seed = 1;
  for (int i = 0; i < width * height * channels; ++i) {
    seed = seed * 1664525U + 1013904223U;
    values.push_back(static_cast<float>(seed >> 24U) / 255.0F);
  }
  return values;
}

inline std::filesystem::path write_bytes(std::string const& name, std::string const& bytes) {
  auto path = temporary(name);
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

// The header of a TARGA file: true colour of 24 bits, 20000 x 20000.
inline std::string huge_targa() {
  constexpr int colour_at = 2;
  constexpr int size_at = 12;
  constexpr int depth_at = 16;
  std::string header(18, '\0');
  header[colour_at] = 2;
  header.replace(size_at, 4, "\x20\x4E\x20\x4E");
  header[depth_at] = 24;
  return header;
}

inline void cut(std::filesystem::path const& path, double share) {
  auto const size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size * share));
}

}  // namespace gpu_shading::energyplus
