// Whatever OpenImageIO says of an image: a format of its own, whose header and texels are the
// input's bytes.

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "files/image_decoder/images.h"
#include "fuzz.h"

namespace {

using namespace gpu_shading;

energyplus::Values* values = nullptr;

// -128 .. 127
int small_number() {
  constexpr int half = 128;
  int const value = values->next<std::uint8_t>();
  return value < half ? value : value - 2 * half;
}

class Layout final : public OIIO::ImageInput {
 public:
  char const* format_name() const override { return exr_ ? "openexr" : "layout"; }

  bool open(std::string const& /*name*/, OIIO::ImageSpec& spec) override {
    auto const flags = values->next<std::uint8_t>();
    exr_ = (flags & 1U) != 0;
    bool const is_near = (flags & 2U) != 0;
    // Sizes that a reader would give memory for, and any place and size of the display window.
    for (auto* const size : {&m_spec.width, &m_spec.height}) {
      *size = static_cast<int>(values->next<std::uint8_t>()) - 1;
    }
    for (auto* const place : {&m_spec.x, &m_spec.y, &m_spec.full_x, &m_spec.full_y,
                              &m_spec.full_width, &m_spec.full_height}) {
      *place = is_near ? small_number() : values->next<std::int32_t>();
    }
    for (auto* const size : {&m_spec.tile_width, &m_spec.tile_height}) {
      *size = is_near ? small_number() : values->next<std::int32_t>();
    }
    if ((flags & 4U) != 0) m_spec.tile_width = 0;
    m_spec.depth = static_cast<int>(values->next_up_to<std::uint8_t>(2));
    m_spec.nchannels = values->next_up_to<std::uint8_t>(9);
    m_spec.alpha_channel = small_number();
    m_spec.deep = (flags & 8U) != 0;
    m_spec.attribute("Orientation",
                     is_near ? values->next_up_to<std::uint8_t>(9) : values->next<std::int32_t>());
    m_spec.default_channel_names();
    spec = m_spec;
    return true;
  }

  bool close() override { return true; }

  bool read_native_scanline(int /*subimage*/, int /*miplevel*/, int /*y*/, int /*z*/,
                            void* /*data*/) override {
    return false;
  }

  bool read_scanlines(int /*subimage*/, int /*miplevel*/, int top, int bottom, int /*z*/, int first,
                      int last, OIIO::TypeDesc /*format*/, void* data, OIIO::stride_t /*x*/,
                      OIIO::stride_t /*y*/) override {
    return fill(data, m_spec.width, std::int64_t{bottom} - top, last - first);
  }

  bool read_tiles(int /*subimage*/, int /*miplevel*/, int left, int right, int top, int bottom,
                  int /*front*/, int /*back*/, int first, int last, OIIO::TypeDesc /*format*/,
                  void* data, OIIO::stride_t /*x*/, OIIO::stride_t /*y*/,
                  OIIO::stride_t /*z*/) override {
    return fill(data, std::int64_t{right} - left, std::int64_t{bottom} - top, last - first);
  }

 private:
  static bool fill(void* data, std::int64_t columns, std::int64_t rows, int channels) {
    auto const result = values->next<std::uint8_t>();
    if (result == 1) return false;
    auto* const to = static_cast<float*>(data);
    auto const texel = std::bit_cast<float>(values->next<std::uint32_t>());
    std::fill(to, to + columns * rows * channels, texel);
    return true;
  }

  bool exr_ = false;
};

OIIO::ImageInput* make_layout() { return new Layout; }

bool register_format() {
  static char const* endings[] = {"layout", nullptr};
  OIIO::declare_imageio_format("layout", make_layout, endings, nullptr, nullptr, "1");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::decoding;
  static bool const registered = register_format();
  energyplus::require(registered);
  static auto const path = energyplus::file_of("layout", "a.layout");
  energyplus::Values all(data, size);
  values = &all;
  try {
    constexpr std::int64_t most = 1 << 16;
    auto const [header, opacity] = read_image({path.c_str(), path, true}, most);
    auto const texels = std::int64_t{header.width} * header.height;
    energyplus::require(header.width > 0 && header.height > 0 && header.channels > 0);
    energyplus::require(static_cast<std::int64_t>(opacity.size()) == (texels > most ? 0 : texels));
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}
