#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"

// Access to binary files of features that may be damaged.
namespace gpu_shading::energyplus::geojson {

Error damaged(std::string_view what);

// Whether a file begins with these bytes, which tell its format.
bool begins_with(std::filesystem::path const& path, std::string_view magic);

// A part of a file; what is beyond the end is an error.
class Bytes {
 public:
  explicit Bytes(std::vector<char> bytes) : bytes_(std::move(bytes)) {}

  std::size_t size() const { return bytes_.size(); }

  template <typename Value>
  Value at(std::size_t place, std::endian order = std::endian::little) const {
    if (place > size() || size() - place < sizeof(Value)) throw damaged("an offset is too large");
    std::array<char, sizeof(Value)> bytes{};
    std::memcpy(bytes.data(), bytes_.data() + place, sizeof(Value));
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Value>(bytes);
  }

  std::string_view text(std::size_t place, std::size_t length) const {
    if (place > size() || size() - place < length) throw damaged("a text is too long");
    return {bytes_.data() + place, length};
  }

 private:
  std::vector<char> bytes_;
};

// Reads values one after another.
struct Cursor {
  Bytes const& bytes;
  std::size_t place = 0;
  std::endian order = std::endian::little;

  template <typename Value>
  Value next() {
    auto const value = bytes.at<Value>(place, order);
    place += sizeof(Value);
    return value;
  }

  std::string_view text(std::size_t length) {
    auto const text = bytes.text(place, length);
    place += length;
    return text;
  }
};

// More in one piece means a damaged file.
inline constexpr std::size_t max_piece = std::size_t{64} << 20U;

class BinaryFile {
 public:
  explicit BinaryFile(std::filesystem::path const& path)
      : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

  std::uintmax_t size() const { return size_; }
  Bytes read(std::uintmax_t place, std::size_t count);

 private:
  std::ifstream file_;
  std::uintmax_t size_;
  // What was read last, because features that are read one after another are often neighbours.
  std::uintmax_t begin_ = 0;
  std::vector<char> window_;
};

}  // namespace gpu_shading::energyplus::geojson
