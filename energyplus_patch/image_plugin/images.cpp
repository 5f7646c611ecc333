#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/c_interface.h"
#include "image_plugin/image_plugin.h"

namespace {

constexpr std::size_t strip_bytes = std::size_t{16} << 20U;

using Input = std::unique_ptr<OIIO::ImageInput>;

Input open(char const* path) {
  auto input = OIIO::ImageInput::open(path);
  if (!input) fail(OIIO::geterror());
  auto const& spec = input->spec();
  if (spec.deep) fail("deep images are not supported");
  if (spec.depth > 1) fail("volume images are not supported");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail("it has no texels");
  return input;
}

// The channels from which opacity is computed, and how.
struct Channels {
  explicit Channels(OIIO::ImageSpec const& spec) {
    if (spec.alpha_channel >= 0) {
      first = spec.alpha_channel;
    } else if (spec.nchannels >= 3) {
      weights = {0.2126F, 0.7152F, 0.0722F};  // ITU-R BT.709
      count = 3;
    }
  }

  float value(float const* texel) const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < count; ++i) sum += weights[i] * texel[i];
    return sum;
  }

  int begin() const { return first; }
  int end() const { return first + static_cast<int>(count); }

  int first = 0;
  std::size_t count = 1;
  std::array<float, 3> weights{1.0F, 0.0F, 0.0F};
};

// Converts the rows of a file to those of a tile: from the bottom, with one channel.
class Writer {
 public:
  Writer(OIIO::ImageSpec const& spec, Channels const& channels, unsigned short* opacity)
      : spec_(spec), channels_(channels), opacity_(opacity) {}

  // Position of a block from the image's top left corner; `stride` texels per row.
  void put(std::vector<float> const& block, int x, int y, int columns, int rows, int stride) {
    for (int row = 0; row < rows; ++row) {
      float const* from = block.data() + index(0, row, stride) * channels_.count;
      unsigned short* const to = opacity_ + index(x, spec_.height - 1 - (y + row), spec_.width);
      for (int column = 0; column < columns; ++column, from += channels_.count) {
        float const value = channels_.value(from);
        if (std::isnan(value)) {
          fail("texel " + std::to_string(x + column + 1) + ", " + std::to_string(y + row + 1) +
               " from the top left is not a number");
        }
        constexpr float most = 65535.0F;
        to[column] = static_cast<unsigned short>(std::lround(std::clamp(value, 0.0F, 1.0F) * most));
      }
    }
  }

 private:
  static std::size_t index(int column, int row, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }

  OIIO::ImageSpec const& spec_;
  Channels const& channels_;
  unsigned short* opacity_;
};

// Number of pieces of a size, in texels, per strip.
int pieces(int width, int height, Channels const& channels) {
  auto const bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                     channels.count * sizeof(float);
  return static_cast<int>(std::max<std::size_t>(1, strip_bytes / bytes));
}

void read_scanlines(OIIO::ImageInput& input, Channels const& channels, Writer& writer) {
  auto const& spec = input.spec();
  int const most = std::min(spec.height, pieces(spec.width, 1, channels));
  std::vector<float> strip(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(most) *
                           channels.count);
  for (int y = 0; y < spec.height; y += most) {
    int const rows = std::min(most, spec.height - y);
    if (!input.read_scanlines(0, 0, spec.y + y, spec.y + y + rows, spec.z, channels.begin(),
                              channels.end(), OIIO::TypeDesc::FLOAT, strip.data())) {
      fail(input.geterror());
    }
    writer.put(strip, 0, y, spec.width, rows, spec.width);
  }
}

void read_tiles(OIIO::ImageInput& input, Channels const& channels, Writer& writer) {
  auto const& spec = input.spec();
  int const most = spec.tile_width * pieces(spec.tile_width, spec.tile_height, channels);
  std::vector<float> block;
  for (int y = 0; y < spec.height; y += spec.tile_height) {
    int const rows = std::min(spec.tile_height, spec.height - y);
    for (int x = 0; x < spec.width; x += most) {
      int const columns = std::min(most, spec.width - x);
      block.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
                   channels.count);
      if (!input.read_tiles(0, 0, spec.x + x, spec.x + x + columns, spec.y + y, spec.y + y + rows,
                            spec.z, spec.z + 1, channels.begin(), channels.end(),
                            OIIO::TypeDesc::FLOAT, block.data())) {
        fail(input.geterror());
      }
      writer.put(block, x, y, columns, rows, columns);
    }
  }
}

}  // namespace

extern "C" EXPORTED int gpu_shading_write_image(char const* path, char const* name, int width,
                                                int height, int channels,
                                                unsigned char const* pixels, char* message,
                                                std::size_t message_size) {
  return guarded(message, message_size, [&] {
    auto const output = OIIO::ImageOutput::create(name);
    if (!output) fail(OIIO::geterror());
    OIIO::ImageSpec const spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels) ||
        !output->close()) {
      fail(output->geterror());
    }
  });
}

extern "C" EXPORTED int gpu_shading_probe_image(char const* path, gpu_shading_image_info* info,
                                                char* message, std::size_t message_size) {
  return guarded(message, message_size, [&] {
    auto const input = open(path);
    auto const& spec = input->spec();
    *info = {spec.width, spec.height, spec.nchannels, spec.alpha_channel};
  });
}

extern "C" EXPORTED int gpu_shading_read_opacity(char const* path, int width, int height,
                                                 unsigned short* opacity, char* message,
                                                 std::size_t message_size) {
  return guarded(message, message_size, [&] {
    auto const input = open(path);
    auto const& spec = input->spec();
    if (spec.width != width || spec.height != height) fail("it changed while it was being read");
    Channels const channels(spec);
    Writer writer(spec, channels, opacity);
    if (spec.tile_width > 0) {
      read_tiles(*input, channels, writer);
    } else {
      read_scanlines(*input, channels, writer);
    }
    // Some readers (JPEG) fill in missing data and only report it.
    if (input->has_error()) fail(input->geterror());
  });
}
