#include "files/image_decoder/tiff.h"

#include <geotiff.h>
#include <xtiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>

#include "files/decoding/decoder.h"

namespace gpu_shading::decoding {
namespace {

struct FreeOptions {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

int keep_error(TIFF* /*file*/, void* message, char const* /*module*/, char const* format,
               va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(message) = text.data();
  return 1;
}

int keep_quiet(TIFF* /*file*/, void* /*data*/, char const* /*module*/, char const* /*format*/,
               va_list /*arguments*/) {
  return 1;
}

}  // namespace

void TiffFile::Close::operator()(TIFF* file) const { XTIFFClose(file); }

TiffFile::TiffFile(char const* path) : error_(std::make_unique<std::string>()) {
  XTIFFInitialize();
  std::unique_ptr<TIFFOpenOptions, FreeOptions> const options(TIFFOpenOptionsAlloc());
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, error_.get());
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
  file_.reset(TIFFOpenExt(path, "r", options.get()));
  if (!file_) throw std::runtime_error(error_->empty() ? "is not a TIFF" : *error_);
}

namespace {

static_assert(std::endian::native == std::endian::little);

// Default values where the file has none.
std::uint16_t field(TiffFile const& file, ttag_t tag) {
  std::uint16_t value = 0;
  TIFFGetFieldDefaulted(file.get(), tag, &value);
  return value;
}

std::uint32_t size(TiffFile const& file, ttag_t tag) {
  std::uint32_t value = 0;
  TIFFGetFieldDefaulted(file.get(), tag, &value);
  return value;
}

// IEEE 754 binary16.
double half(std::uint64_t bits) {
  constexpr unsigned mantissa_bits = 10;
  constexpr std::uint64_t special = 31;
  auto const mantissa = static_cast<double>(bits & 0x3FFU);
  auto const exponent = bits >> mantissa_bits & special;
  double value = 0.0;
  if (exponent == special) {
    value = mantissa == 0.0 ? std::numeric_limits<double>::infinity()
                            : std::numeric_limits<double>::quiet_NaN();
  } else if (exponent == 0) {
    value = std::ldexp(mantissa, -24);
  } else {
    value = std::ldexp(mantissa + 1024.0, static_cast<int>(exponent) - 25);
  }
  return (bits >> 15U & 1U) != 0 ? -value : value;
}

// How a sample is stored.
class Encoding {
 public:
  explicit Encoding(TiffFile const& file)
      : bits_(field(file, TIFFTAG_BITSPERSAMPLE)), format_(field(file, TIFFTAG_SAMPLEFORMAT)) {
    auto const channels = field(file, TIFFTAG_SAMPLESPERPIXEL);
    if (channels != 1) {
      fail("it has " + std::to_string(channels) + " channels, expected one with elevations");
    }
    std::uint16_t meaning = PHOTOMETRIC_MINISBLACK;
    TIFFGetField(file.get(), TIFFTAG_PHOTOMETRIC, &meaning);
    if (meaning != PHOTOMETRIC_MINISBLACK && meaning != PHOTOMETRIC_MINISWHITE) {
      fail("its PhotometricInterpretation is " + std::to_string(meaning) + ", expected 0 or 1");
    }
    bool const whole = format_ == SAMPLEFORMAT_UINT || format_ == SAMPLEFORMAT_INT;
    bool const real = format_ == SAMPLEFORMAT_IEEEFP;
    // Writers disagree about the order of three bytes.
    bool const wide = bits_ == 32 || bits_ == 64;
    if (whole && (wide || (bits_ >= 1 && bits_ < 32 && bits_ != 24))) return;
    if (real && (wide || bits_ == 16)) return;
    if (whole || real) {
      fail("its BitsPerSample is " + std::to_string(bits_) + ", expected " +
           (whole ? "1 to 23, 25 to 32 or 64" : "16, 32 or 64"));
    }
    fail("its SampleFormat is " + std::to_string(format_) +
         ", expected 1 (unsigned), 2 (signed) or 3 (floating point)");
  }

  bool single_precision() const { return format_ == SAMPLEFORMAT_IEEEFP && bits_ == 32; }

  double value(std::span<unsigned char const> row, std::size_t column) const {
    auto const number = stored(row, column);
    if (format_ == SAMPLEFORMAT_IEEEFP) {
      return bits_ == 16   ? half(number)
             : bits_ == 32 ? std::bit_cast<float>(static_cast<std::uint32_t>(number))
                           : std::bit_cast<double>(number);
    }
    if (format_ == SAMPLEFORMAT_UINT) return static_cast<double>(number);
    auto const unused = 64U - bits_;
    return static_cast<double>(static_cast<std::int64_t>(number << unused) >> unused);
  }

 private:
  std::uint64_t stored(std::span<unsigned char const> row, std::size_t column) const {
    std::uint64_t number = 0;
    if (bits_ % 8 == 0) {  // libtiff brought whole bytes into the order of this machine
      auto const bytes = row.subspan(column * (bits_ / 8U), bits_ / 8U);
      std::memcpy(&number, bytes.data(), bytes.size());
      return number;
    }
    auto const first = column * bits_;
    for (auto at = first; at < first + bits_; ++at) {
      number = number << 1U | (row[at / 8] >> (7U - at % 8) & 1U);
    }
    return number;
  }

  unsigned bits_;
  std::uint16_t format_;
};

// The strips or tiles of an image.
class Pieces {
 public:
  explicit Pieces(TiffFile const& file)
      : file_(file),
        tiled_(TIFFIsTiled(file.get()) != 0),
        columns_(size(file, TIFFTAG_IMAGEWIDTH)),
        rows_(size(file, TIFFTAG_IMAGELENGTH)),
        piece_columns_(tiled_ ? size(file, TIFFTAG_TILEWIDTH) : columns_),
        piece_rows_(size(file, tiled_ ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP)),
        count_(tiled_ ? TIFFNumberOfTiles(file.get()) : TIFFNumberOfStrips(file.get())),
        row_bytes_(tiled_ ? TIFFTileRowSize64(file.get()) : TIFFScanlineSize64(file.get())),
        bytes_(tiled_ ? TIFFTileSize64(file.get()) : TIFFStripSize64(file.get())) {
    if (!tiled_) piece_rows_ = std::min(piece_rows_, rows_);
    constexpr std::uint64_t max_bytes = std::uint64_t{64} << 20U;
    if (bytes_ == 0 || bytes_ > max_bytes || piece_columns_ == 0 || piece_rows_ == 0) {
      fail("its " + name() + "s are of " + std::to_string(bytes_) +
           " bytes, expected at most 64 MiB");
    }
    auto const expected = std::uint64_t{across()} * parts(rows_, piece_rows_);
    if (count_ != expected) {
      fail("it has " + std::to_string(count_) + " " + name() + "s, expected " +
           std::to_string(expected));
    }
  }

  std::vector<double> read(Encoding const& encoding) const {
    std::vector<double> values(std::size_t{columns_} * rows_);
    std::vector<unsigned char> bytes(bytes_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      auto const left = std::size_t{i % across()} * piece_columns_;
      auto const top = std::size_t{i / across()} * piece_rows_;
      auto const columns = std::min<std::size_t>(piece_columns_, columns_ - left);
      auto const rows = std::min<std::size_t>(piece_rows_, rows_ - top);
      decode(i, tiled_ ? bytes_ : rows * row_bytes_, bytes);
      for (std::size_t row = 0; row < rows; ++row) {
        auto const line = std::span(bytes).subspan(row * row_bytes_, row_bytes_);
        auto* const to = values.data() + (top + row) * columns_ + left;
        for (std::size_t column = 0; column < columns; ++column) {
          to[column] = encoding.value(line, column);
        }
      }
    }
    return values;
  }

 private:
  static std::uint32_t parts(std::uint32_t length, std::uint32_t part) {
    return (length + part - 1) / part;
  }
  std::uint32_t across() const { return parts(columns_, piece_columns_); }
  std::string name() const { return tiled_ ? "tile" : "strip"; }

  void decode(std::uint32_t i, std::uint64_t expected, std::vector<unsigned char>& bytes) const {
    auto* const tiff = file_.get();
    auto const capacity = static_cast<tmsize_t>(bytes.size());
    auto const got = TIFFGetStrileByteCount(tiff, i) == 0
                         ? 0
                         : (tiled_ ? TIFFReadEncodedTile(tiff, i, bytes.data(), capacity)
                                   : TIFFReadEncodedStrip(tiff, i, bytes.data(), capacity));
    if (got >= 0 && static_cast<std::uint64_t>(got) == expected) return;
    fail("is damaged: " + name() + " " + std::to_string(i + 1) + " of " + std::to_string(count_) +
         (got == 0 ? " is empty" : " cannot be decoded") +
         (file_.error().empty() ? "" : ": " + file_.error()));
  }

  TiffFile const& file_;
  bool tiled_;
  std::uint32_t columns_;
  std::uint32_t rows_;
  std::uint32_t piece_columns_;
  std::uint32_t piece_rows_;
  std::uint32_t count_;
  std::uint64_t row_bytes_;
  std::uint64_t bytes_;
};

}  // namespace

TiffSamples read_samples(TiffFile const& file) {
  Encoding const encoding(file);
  return {.values = Pieces(file).read(encoding), .single_precision = encoding.single_precision()};
}

namespace {

// Ends what TIFFRGBAImageBegin() began.
struct End {
  void operator()(TIFFRGBAImage* image) const { TIFFRGBAImageEnd(image); }
};

}  // namespace

std::optional<SmallTiff> read_small_tiff(char const* path, bool with_texels) {
  constexpr std::uint16_t full = 8;
  TiffFile const file(path);
  std::uint16_t bits = 1;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  if (bits >= full) return std::nullopt;
  constexpr std::uint32_t max_side = 1U << 30U;
  SmallTiff small;
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_ORIENTATION, &orientation);
  small.orientation = orientation;
  if (TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &small.width) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &small.height) == 0 || small.width == 0 ||
      small.height == 0 || small.width > max_side || small.height > max_side) {
    throw std::runtime_error("its size is out of range");
  }
  TIFFRGBAImage image{};
  std::array<char, 1024> why{};
  constexpr int stop_on_error = 1;
  if (TIFFRGBAImageBegin(&image, file.get(), stop_on_error, why.data()) == 0) {
    throw std::runtime_error(why.data());
  }
  std::unique_ptr<TIFFRGBAImage, End> const open(&image);
  small.alpha = image.alpha != 0;
  if (!with_texels) return small;
  small.texels.resize(std::size_t{small.width} * small.height);
  image.req_orientation = image.orientation;  // rows and columns as they are stored
  if (TIFFRGBAImageGet(&image, small.texels.data(), small.width, small.height) == 0) {
    throw std::runtime_error(file.error().empty() ? "it is damaged" : file.error());
  }
  return small;
}

}  // namespace gpu_shading::decoding
