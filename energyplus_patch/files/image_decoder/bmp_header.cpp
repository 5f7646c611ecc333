#include "files/image_decoder/bmp_header.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

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

}  // namespace gpu_shading::decoding
