#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "files/image_file.h"
#include "support/refusal.h"
#include "test_images.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;
using testing::Not;

using Texels = std::vector<std::uint16_t>;

constexpr std::uint16_t full = 65535;

Texels opacity_of(std::filesystem::path const& path) {
  return read_opacity(path, probe_texture(path));
}

std::string refusal(std::filesystem::path const& path) {
  return refusal_of([&] { opacity_of(path); });
}

TEST(TextureFile, RowsAreCountedFromTheBottom) {
  for (auto const* name : {"rows.png", "rows.tif", "rows.tga", "rows.exr", "rows.bmp"}) {
    auto const format =
        std::string(name) == "rows.exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8;
    auto const path = write_texture(name, 2, 3, 1, {1, 0, 0, 0, 0, 1}, format);
    EXPECT_EQ(opacity_of(path), (Texels{0, full, 0, 0, full, 0})) << name;
  }
}

TEST(TextureFile, AlphaComesBeforeLuminance) {
  auto const path = write_texture("alpha.png", 2, 1, 4, {1, 1, 1, 0.2F, 0, 0, 0, 0.8F});
  auto const info = probe_texture(path);
  EXPECT_EQ(info.channels, 4);
  EXPECT_TRUE(info.alpha);
  EXPECT_EQ(opacity_of(path), (Texels{51 * 257, 204 * 257}));
  auto const grey = write_texture("grey_alpha.png", 1, 1, 2, {1, 0.4F});
  EXPECT_TRUE(probe_texture(grey).alpha);
  EXPECT_EQ(opacity_of(grey), (Texels{102 * 257}));
}

TEST(TextureFile, LuminanceWhereThereIsNoAlpha) {
  auto const path = write_texture("rgb.tif", 4, 1, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_FALSE(probe_texture(path).alpha);
  auto const texels = opacity_of(path);
  EXPECT_NEAR(texels[0], 0.2126 * full, 1.0);
  EXPECT_NEAR(texels[1], 0.7152 * full, 1.0);
  EXPECT_NEAR(texels[2], 0.0722 * full, 1.0);
  EXPECT_EQ(texels[3], full);
}

TEST(TextureFile, OneTexel) {
  EXPECT_EQ(opacity_of(write_texture("one.png", 1, 1, 1, {1})), Texels{full});
}

TEST(TextureFile, SixteenBitsAreKept) {
  auto const path = write_texture("deep.png", 2, 1, 1, {12345.0F / full, 54321.0F / full},
                                  OIIO::TypeDesc::UINT16);
  EXPECT_EQ(opacity_of(path), (Texels{12345, 54321}));
}

TEST(TextureFile, FloatsAreClamped) {
  auto const path = write_texture("range.exr", 4, 1, 1,
                                  {-3.0F, 0.25F, 7.5F, std::numeric_limits<float>::infinity()},
                                  OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(opacity_of(path), (Texels{0, 16384, full, full}));
}

TEST(TextureFile, WhatIsNotANumberIsRefused) {
  auto const path =
      write_texture("nan.exr", 2, 2, 1, {0, 0, std::nanf(""), 0}, OIIO::TypeDesc::FLOAT);
  EXPECT_THAT(refusal(path), HasSubstr("texel 1, 2 from the top left is not a number"));
}

TEST(TextureFile, TilesAndScanlinesAreTheSame) {
  constexpr int width = 150;
  constexpr int height = 70;
  auto const values = noise(width, height, 3);
  auto const rows = write_texture("rows_rgb.tif", width, height, 3, values);
  auto const tiles =
      write_texture("tiles_rgb.tif", width, height, 3, values, OIIO::TypeDesc::UINT8, 64);
  EXPECT_EQ(opacity_of(rows), opacity_of(tiles));
}

TEST(TextureFile, MoreThanAStrip) {
  // 16 MiB of float hold 1024 rows of these.
  constexpr int side = 4096;
  std::vector<float> values(static_cast<std::size_t>(side) * side, 0.0F);
  values.front() = 1.0F;
  values[values.size() - 2] = 1.0F;
  auto const texels = opacity_of(write_texture("strips.png", side, side, 1, values));
  EXPECT_EQ(texels[static_cast<std::size_t>(side) * (side - 1)], full);
  EXPECT_EQ(texels[side - 2], full);
  EXPECT_EQ(std::count(texels.begin(), texels.end(), full), 2);
}

TEST(TextureFile, TruncatedFilesAreRefused) {
  constexpr int side = 256;
  for (auto const* name : {"cut.png", "cut.tif", "cut.jpg", "cut.tga", "cut.bmp", "cut.exr"}) {
    auto const path = write_texture(name, side, side, 3, noise(side, side, 3));
    ASSERT_EQ(refusal(path), "accepted") << name;
    cut(path, 0.5);
    auto const message = refusal(path);
    EXPECT_THAT(message, HasSubstr(name));
    EXPECT_THAT(message, HasSubstr("be read")) << name;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << name;
  }
}

TEST(TextureFile, CorruptFilesAreRefused) {
  auto const path = write_texture("corrupt.png", 64, 64, 3, noise(64, 64, 3));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(200);
  file << "this is not how it was compressed";
  file.close();
  EXPECT_THAT(refusal(path), HasSubstr("corrupt.png: cannot be read: "));
}

TEST(TextureFile, WhatIsNoImageIsRefused) {
  EXPECT_THAT(refusal(temporary("missing.png")), HasSubstr("missing.png: no such file"));
  EXPECT_THAT(refusal(testing::TempDir()), HasSubstr("is not a file"));
  for (auto const* name : {"text.png", "text.txt", "text"}) {
    auto const message = refusal(write_bytes(name, "two\nlines of text\n"));
    EXPECT_THAT(message, HasSubstr("cannot be read: ")) << name;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << name;
  }
  EXPECT_THAT(refusal(write_bytes("empty.png", "")), HasSubstr("cannot be read"));
}

TEST(TextureFile, TooLargeIsSaidByTheHeader) {
  EXPECT_THAT(refusal(write_bytes("huge.tga", huge_targa())),
              HasSubstr("huge.tga: is 20000 x 20000 texels, expected at most 16384"));
}

TEST(TextureFile, OtherFormatsAreReadWithTheFlagAlone) {
  auto const path = write_texture("rows.pgm", 2, 1, 1, {1, 0});
  EXPECT_THAT(refusal(path), HasSubstr("rows.pgm: cannot be read: its name ends in .pgm, "
                                       "expected a PNG, JPEG, TIFF, EXR, BMP, TGA or HDR image"));
  EXPECT_EQ(read_opacity(path, probe_texture(path, Assets::any), Assets::any), (Texels{full, 0}));
}

// Each made OpenImageIO crash, write beyond its memory or run on in this process.
TEST(TextureFile, DamagedFilesOfOtherFormats) {
  auto const icon = std::string("\0\0\1\0\1\0", 6) + std::string("\x10\x10\0\0\0\0\0\0", 8) +
                    std::string("\x28\4\0\0\x16\0\0\0", 8) + std::string("\x28\0\0\0", 4) +
                    std::string(60, '\0');
  auto const dds = "DDS " + std::string("\x7c\0\0\0\7\x10\0\0", 8) +
                   std::string("\0\x40\0\0\0\x40\0\0", 8) + std::string(108, '\x44');
  auto const iff = std::string(
                       "FOR4\0\0\0\x64"
                       "CIMGTBHD\0\0\0\x20",
                       20) +
                   std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8) + std::string(80, '\x7f');
  for (auto const& [name, bytes] :
       {std::pair{"a.ico", icon}, std::pair{"a.dds", dds}, std::pair{"a.iff", iff}}) {
    auto const path = write_bytes(name, bytes);
    EXPECT_THAT(refusal(path), HasSubstr("cannot be read: its name ends in ")) << name;
    auto const hidden = write_bytes("hidden.png", bytes);
    EXPECT_THAT(refusal(hidden), HasSubstr("its content is of no such format")) << name;
    for (auto const& file : {path, hidden}) {
      auto const message = refusal_of([&] {
        auto const info = probe_texture(file, Assets::any);
        read_opacity(file, info, Assets::any);
      });
      EXPECT_THAT(message, HasSubstr(file.filename().string() + ": ")) << name;
      EXPECT_THAT(message, Not(HasSubstr("\n"))) << name;
    }
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
