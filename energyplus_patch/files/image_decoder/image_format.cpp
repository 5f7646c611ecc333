#include "files/image_decoder/image_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace gpu_shading::decoding {
namespace {

// From the file's start: a file header of 14 bytes, then that of the image.
constexpr std::size_t size_at = 14;
constexpr std::size_t depth_at = 28;
constexpr std::size_t compression_at = 30;
constexpr std::size_t masks_at = 54;
constexpr std::uint32_t bit_fields = 3;
constexpr std::uint32_t size_with_alpha_mask = 56;

}  // namespace

bool bmp_has_alpha(char const* path) {
  std::array<char, 70> header{};
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  auto const number = [&](std::size_t at) {  // little-endian, as this machine
    std::uint32_t value = 0;
    std::memcpy(&value, header.data() + at, sizeof value);
    return value;
  };
  if (number(compression_at) != bit_fields) return false;
  constexpr std::uint32_t depth_mask = 0xFFFF;
  constexpr std::uint32_t full_depth = 32;
  constexpr std::array<std::uint32_t, 3> usual{0xFF0000, 0xFF00, 0xFF};
  bool expected = (number(depth_at) & depth_mask) == full_depth;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    expected = expected && number(masks_at + i * sizeof(std::uint32_t)) == usual.at(i);
  }
  auto const alpha = number(size_at) >= size_with_alpha_mask
                         ? number(masks_at + usual.size() * sizeof(std::uint32_t))
                         : 0;
  constexpr std::uint32_t usual_alpha = 0xFF000000;
  if (!expected || (alpha != 0 && alpha != usual_alpha)) {
    throw std::runtime_error("its bit fields are not 8 bits each of blue, green, red and alpha");
  }
  return alpha != 0;
}

namespace {

using namespace std::string_view_literals;

constexpr auto expected =
    "expected a PNG, JPEG, TIFF, EXR, BMP, TGA or HDR image (--gpu-shading-assets=any reads more)";

struct Mark {
  std::string_view bytes;
  std::string_view format;
};

constexpr std::array marks{Mark{"\x89PNG\r\n\x1a\n"sv, "png"},
                           Mark{"\xff\xd8\xff"sv, "jpeg"},
                           Mark{"II*\0"sv, "tiff"},
                           Mark{"MM\0*"sv, "tiff"},
                           Mark{"II+\0"sv, "tiff"},
                           Mark{"MM\0+"sv, "tiff"},
                           Mark{"\x76\x2f\x31\x01"sv, "openexr"},
                           Mark{"BM"sv, "bmp"},
                           Mark{"#?RADIANCE"sv, "hdr"},
                           Mark{"#?RGBE"sv, "hdr"}};

constexpr std::array endings{".png"sv, ".jpg"sv, ".jpeg"sv, ".tif"sv, ".tiff"sv,
                             ".exr"sv, ".bmp"sv, ".tga"sv,  ".hdr"sv};

}  // namespace

std::string format_by_content(char const* path) {
  std::array<char, 16> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), first.size());
  std::string_view const start(first.data(), static_cast<std::size_t>(file.gcount()));
  for (auto const& mark : marks) {
    if (start.starts_with(mark.bytes)) return std::string(mark.format);
  }
  return {};
}

std::string restricted_format(char const* path, std::filesystem::path const& name) {
  auto ending = name.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    throw std::runtime_error(
        (ending.empty() ? "its name has no ending" : "its name ends in " + ending) + ", " +
        expected);
  }
  auto format = format_by_content(path);
  if (!format.empty()) return format;
  if (ending == ".tga") return "targa";
  throw std::runtime_error(std::string("its content is of no such format: ") + expected);
}

}  // namespace gpu_shading::decoding
