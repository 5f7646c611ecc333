#include "files/image_decoder/image_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace gpu_shading::decoding {
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
