#include "files/image_decoder/images.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "files/decoding/decoder.h"
#include "files/image_decoder/image_format.h"
#include "files/image_decoder/tiff.h"

namespace gpu_shading::decoding {
namespace {

constexpr std::size_t strip_bytes = std::size_t{16} << 20U;
constexpr std::array luminance{0.2126F, 0.7152F, 0.0722F};  // ITU-R BT.709
constexpr float solid = 65535.0F;

using Input = std::unique_ptr<OIIO::ImageInput>;

Input open_as(std::string const& format, char const* path) {
  auto input = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec;
  if (!input) fail(OIIO::geterror());
  if (!input->open(path, spec)) fail(input->geterror());
  return input;
}

// In the format that the name's ending stands for, else in any.
Input open_any(ImageFile const& file) {
  auto ending = file.name.extension().string();
  ending.erase(0, 1);
  OIIO::ImageSpec spec;
  if (!ending.empty() && ending.find('?') == std::string::npos) {
    auto input = OIIO::ImageInput::create(ending);
    if (input && input->open(file.path, spec)) return input;
    OIIO::geterror();
  }
  auto input = OIIO::ImageInput::open(file.path);
  if (!input) fail(OIIO::geterror());
  return input;
}

// Columns and rows of texels, from the top left.
struct Window {
  std::int64_t left = 0;
  std::int64_t top = 0;
  std::int64_t width = 0;
  std::int64_t height = 0;
};

// How a picture is stored, for EXIF's orientations 1 to 8.
struct Orientation {
  bool turned;       // its rows are columns
  bool mirrored;     // then, from right to left
  bool upside_down;  // and from the bottom
};
constexpr std::array<Orientation, 8> orientations{{{false, false, false},
                                                   {false, true, false},
                                                   {false, true, true},
                                                   {false, false, true},
                                                   {true, false, false},
                                                   {true, true, false},
                                                   {true, true, true},
                                                   {true, false, true}}};

// Where the texels of a file belong in the picture as displayed.
class Placement {
 public:
  Placement(Window const& data, Window const& display, int orientation)
      : left_(data.left - display.left),
        top_(data.top - display.top),
        across_(display.width),
        down_(display.height) {
    if (orientation < 1 || orientation > static_cast<int>(orientations.size())) return;
    stored_ = orientations.at(static_cast<std::size_t>(orientation - 1));
  }

  std::int64_t width() const { return stored_.turned ? down_ : across_; }
  std::int64_t height() const { return stored_.turned ? across_ : down_; }
  std::size_t texels() const { return static_cast<std::size_t>(width() * height()); }

  // The number of a texel of the file's data, counted from the bottom row; `none` beyond the
  // display window.
  std::size_t index(std::int64_t column, std::int64_t row) const {
    auto x = column + left_;
    auto y = row + top_;
    if (x < 0 || x >= across_ || y < 0 || y >= down_) return none;
    if (stored_.turned) std::swap(x, y);
    if (stored_.mirrored) x = width() - 1 - x;
    if (!stored_.upside_down) y = height() - 1 - y;
    return static_cast<std::size_t>(y * width() + x);
  }

  static constexpr std::size_t none = ~std::size_t{0};

 private:
  std::int64_t left_;
  std::int64_t top_;
  std::int64_t across_;
  std::int64_t down_;
  Orientation stored_ = orientations.front();
};

ImageHeader header_of(Placement const& placement, int channels, bool alpha) {
  constexpr std::int64_t max_side = std::int64_t{1} << 30U;
  if (placement.width() < 1 || placement.height() < 1) fail("it has no texels");
  return {static_cast<std::int32_t>(std::min(placement.width(), max_side)),
          static_cast<std::int32_t>(std::min(placement.height(), max_side)), channels,
          alpha ? 1 : 0};
}

std::uint16_t opacity_of(float value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * solid));
}

// An image as OpenImageIO opens it.
class OpenImage {
 public:
  explicit OpenImage(ImageFile const& file)
      : input_(file.any ? open_any(file)
                        : open_as(restricted_format(file.path, file.name), file.path)),
        spec_(input_->spec()),
        placement_(data(), display(), spec_.get_int_attribute("Orientation", 1)) {
    if (spec_.deep) fail("deep images are not supported");
    if (spec_.depth > 1) fail("volume images are not supported");
    if (spec_.width < 1 || spec_.height < 1 || spec_.nchannels < 1) fail("it has no texels");
    if (spec_.tile_width > 0 && spec_.tile_height < 1) fail("its tiles have no rows");
    check_end(spec_.x, spec_.width);
    check_end(spec_.y, spec_.height);
    find_channels(file.path);
  }

  ImageHeader header() const { return header_of(placement_, spec_.nchannels, alpha_); }

  std::vector<std::uint16_t> opacity() {
    std::vector<std::uint16_t> result(placement_.texels());
    if (spec_.tile_width > 0) {
      read_tiles(result);
    } else {
      read_scanlines(result);
    }
    // Some readers (JPEG) fill in missing data and only report it.
    if (input_->has_error()) fail(input_->geterror());
    return result;
  }

 private:
  Window data() const { return {spec_.x, spec_.y, spec_.width, spec_.height}; }

  // OpenImageIO counts with int.
  static void check_end(std::int64_t start, std::int64_t size) {
    if (start + size > std::numeric_limits<int>::max()) fail("its position is out of range");
  }

  // Other formats than EXR have none, and TIFF's position on the page is none.
  Window display() const {
    if (std::string_view(input_->format_name()) != "openexr") return data();
    return {spec_.full_x, spec_.full_y, spec_.full_width, spec_.full_height};
  }

  void find_channels(char const* path) {
    std::string_view const format = input_->format_name();
    int alpha = spec_.alpha_channel;
    // OpenImageIO's GIF reader gives the number of channels, not that of the last one, and its
    // TARGA reader does not know the second channel of grey images.
    if (alpha >= spec_.nchannels) alpha = spec_.channelindex("A");
    if (format == "targa" && spec_.nchannels == 2) alpha = 1;
    if (format == "bmp" && alpha >= 0 && !bmp_has_alpha(path)) alpha = -1;
    alpha_ = alpha >= 0;
    if (alpha_) {
      first_ = alpha;
    } else if (spec_.nchannels >= 3) {
      count_ = luminance.size();
    }
  }

  float value(float const* texel) const {
    if (count_ == 1) return texel[0];
    return luminance[0] * texel[0] + luminance[1] * texel[1] + luminance[2] * texel[2];
  }

  // A block whose top left texel is at `x`, `y` of the data.
  void put(std::vector<float> const& block, int x, int y, int columns, int rows,
           std::vector<std::uint16_t>& result) const {
    float const* from = block.data();
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column, from += count_) {
        auto const opacity = value(from);
        if (std::isnan(opacity)) {
          fail("texel " + std::to_string(x + column + 1) + ", " + std::to_string(y + row + 1) +
               " from the top left is not a number");
        }
        auto const to = placement_.index(x + column, y + row);
        if (to != Placement::none) result[to] = opacity_of(opacity);
      }
    }
  }

  // How many pieces of a size, in texels, are read at once.
  int pieces(int width, int height) const {
    auto const bytes =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * count_ * sizeof(float);
    return static_cast<int>(std::max<std::size_t>(1, strip_bytes / bytes));
  }

  int last() const { return first_ + static_cast<int>(count_); }

  void read_scanlines(std::vector<std::uint16_t>& result) {
    int const max_rows = std::min(spec_.height, pieces(spec_.width, 1));
    std::vector<float> strip(static_cast<std::size_t>(spec_.width) *
                             static_cast<std::size_t>(max_rows) * count_);
    for (int y = 0; y < spec_.height; y += max_rows) {
      int const rows = std::min(max_rows, spec_.height - y);
      if (!input_->read_scanlines(0, 0, spec_.y + y, spec_.y + y + rows, spec_.z, first_, last(),
                                  OIIO::TypeDesc::FLOAT, strip.data())) {
        fail(input_->geterror());
      }
      put(strip, 0, y, spec_.width, rows, result);
    }
  }

  void read_tiles(std::vector<std::uint16_t>& result) {
    int const max_columns = spec_.tile_width * pieces(spec_.tile_width, spec_.tile_height);
    std::vector<float> block;
    for (int y = 0; y < spec_.height; y += spec_.tile_height) {
      int const rows = std::min(spec_.tile_height, spec_.height - y);
      for (int x = 0; x < spec_.width; x += max_columns) {
        int const columns = std::min(max_columns, spec_.width - x);
        block.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * count_);
        if (!input_->read_tiles(0, 0, spec_.x + x, spec_.x + x + columns, spec_.y + y,
                                spec_.y + y + rows, spec_.z, spec_.z + 1, first_, last(),
                                OIIO::TypeDesc::FLOAT, block.data())) {
          fail(input_->geterror());
        }
        put(block, x, y, columns, rows, result);
      }
    }
  }

  Input input_;
  OIIO::ImageSpec const& spec_;
  Placement placement_;
  bool alpha_ = false;
  int first_ = 0;
  std::size_t count_ = 1;
};

std::optional<SmallTiff> small_tiff(ImageFile const& file, bool with_texels) {
  auto const format =
      file.any ? format_by_content(file.path) : restricted_format(file.path, file.name);
  if (format != "tiff") return std::nullopt;
  return read_small_tiff(file.path, with_texels);
}

Placement placement_of(SmallTiff const& small) {
  Window const all{0, 0, small.width, small.height};
  return {all, all, small.orientation};
}

ImageHeader header_of(SmallTiff const& small) {
  return header_of(placement_of(small), small.alpha ? 4 : 3, small.alpha);
}

std::vector<std::uint16_t> opacity_of(SmallTiff const& small) {
  auto const placement = placement_of(small);
  std::vector<std::uint16_t> result(small.texels.size());
  constexpr float full = 255.0F;
  auto const channel = [](std::uint32_t texel, unsigned number) {
    constexpr unsigned bits = 8;
    constexpr std::uint32_t mask = 0xFF;
    return static_cast<float>(texel >> (number * bits) & mask) / full;
  };
  constexpr unsigned alpha = 3;
  std::size_t next = 0;
  for (std::int64_t row = 0; row < small.height; ++row) {
    for (std::int64_t column = 0; column < small.width; ++column) {
      auto const texel = small.texels[next++];
      float const value = small.alpha ? channel(texel, alpha)
                                      : luminance[0] * channel(texel, 0) +
                                            luminance[1] * channel(texel, 1) +
                                            luminance[2] * channel(texel, 2);
      result[placement.index(column, row)] = opacity_of(value);
    }
  }
  return result;
}

}  // namespace

Image read_image(ImageFile const& file, std::int64_t max_texels_wanted) {
  Image result;
  auto const is_small_enough = [&] {
    return std::int64_t{result.header.width} * result.header.height <= max_texels_wanted;
  };
  if (auto const small = small_tiff(file, false)) {
    result.header = header_of(*small);
    if (is_small_enough()) result.opacity = opacity_of(*small_tiff(file, true));
    return result;
  }
  OpenImage image(file);
  result.header = image.header();
  if (is_small_enough()) result.opacity = image.opacity();
  return result;
}

}  // namespace gpu_shading::decoding
