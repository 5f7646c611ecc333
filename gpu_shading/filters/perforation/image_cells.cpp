#include "filters/perforation/image_cells.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "platform/instructions.h"

namespace gpu_shading {
namespace {

constexpr int word_bits = 64;

// Finer cells are more often known, and coarser ones found sooner.
int cells_per_texel(OpacityTile const& image) {
  std::size_t const texels = image.opacity().size();
  constexpr std::size_t few = std::size_t{1} << 17U;
  constexpr std::size_t many = std::size_t{1} << 20U;
  return texels <= few ? 4 : texels <= many ? 2 : 1;
}

// The opacity at the corners of cells, which bounds that within, as bits.
struct CornerBits {
  std::vector<std::uint64_t> some_solid;
  std::vector<std::uint64_t> solid;
};

// Sets a bit at a column and wherever that repeats.
void set_repeated(std::span<std::uint64_t> words, int column, int columns) {
  auto const end = static_cast<int>(words.size()) * word_bits;
  for (int bit = column; bit < end; bit += columns) {
    words[static_cast<std::size_t>(bit / word_bits)] |= std::uint64_t{1}
                                                        << static_cast<unsigned>(bit % word_bits);
  }
}

class Corners {
 public:
  Corners(OpacityTile const& image, int per_texel) : image_(image), per_texel_(per_texel) {
    // Single precision, in which rays meet texels, is off by less.
    constexpr double rounding = 0.05;
    if (auto const threshold = image.threshold()) {
      double const limit = *threshold * OpacityTile::solid_texel;
      max_open_ = std::max(0.0, limit - rounding);
      min_solid_ = limit + rounding;
    } else {
      max_open_ = 0.0;
      min_solid_ = OpacityTile::solid_texel;
    }
  }

  // Of a row of corners; the words have zeros.
  void find(int row, std::span<std::uint64_t> some_solid, std::span<std::uint64_t> solid) const {
    int const columns = image_.columns();
    std::uint16_t const* const low = texels(row / per_texel_ - 1);
    std::uint16_t const* const high = texels(row / per_texel_);
    double const up = static_cast<double>(row % per_texel_) / per_texel_;
    for (int column = 0; column < columns; ++column) {
      int const left = column == 0 ? columns - 1 : column - 1;
      double const from = at(low[left], high[left], up);
      double const to = at(low[column], high[column], up);
      for (int part = 0; part < per_texel_; ++part) {
        double const opacity = from + (to - from) * part / per_texel_;
        int const corner = column * per_texel_ + part;
        if (opacity > max_open_) set_repeated(some_solid, corner, columns * per_texel_);
        if (opacity >= min_solid_) set_repeated(solid, corner, columns * per_texel_);
      }
    }
  }

 private:
  static double at(double low, double high, double part) { return low + (high - low) * part; }
  std::uint16_t const* texels(int row) const {
    int const found = row < 0 ? image_.rows() - 1 : row;
    return image_.opacity().data() +
           static_cast<std::size_t>(found) * static_cast<std::size_t>(image_.columns());
  }

  OpacityTile const& image_;
  int per_texel_;
  double max_open_;
  double min_solid_;
};

// The bits from a position on.
std::uint64_t bits_from(std::uint64_t const* words, unsigned bit) {
  return words[0] >> bit | words[1] << 1U << (word_bits - 1U - bit);
}

// Joins the bits of three columns and three rows: corners of two cells each way.
template <typename Join>
std::vector<std::uint64_t> joined(std::vector<std::uint64_t> const& corners, std::size_t rows,
                                  std::size_t stride, Join join) {
  std::vector<std::uint64_t> along(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bool const last = (i + 1) % stride == 0;
    std::array const pair{corners[i], last ? std::uint64_t{0} : corners[i + 1]};
    along[i] = join(join(pair[0], bits_from(pair.data(), 1)), bits_from(pair.data(), 2));
  }
  std::vector<std::uint64_t> both(corners.size());
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint64_t const* const first = &along[row * stride];
    std::uint64_t const* const second = &along[(row + 1) % rows * stride];
    std::uint64_t const* const third = &along[(row + 2) % rows * stride];
    for (std::size_t i = 0; i < stride; ++i) {
      both[row * stride + i] = join(join(first[i], second[i]), third[i]);
    }
  }
  return both;
}

// For each ray its word and its bit there; or else, near the edge of a cell, what the word after
// all others has.
struct Places {
  alignas(32) std::array<std::uint32_t, ImageCells::most> words;
  alignas(32) std::array<std::uint32_t, ImageCells::most> bits;
};

struct Lattice {
  glm::uvec2 cells;      // of the sides
  std::uint32_t stride;  // words of a row
  std::uint32_t unknown;
};

// Whether the cell of a position is in doubt, of which `product` is the part in 2^-32 of a cell:
// positions are rounded by half a multiple, 64 times.
[[gnu::always_inline]] inline bool is_near_edge(std::uint32_t product, std::uint32_t cells) {
  std::uint32_t const doubt = 64 * cells;
  return product + doubt < 2 * doubt;
}

// Written so that the compiler can vectorise over rays.
[[gnu::always_inline]] inline void find_places(Lattice const& lattice, TilePositions const& rays,
                                               Places& places) {
  for (std::uint32_t i = 0; i < ImageCells::most; ++i) {
    std::uint32_t const x = rays.first.x + i * rays.step.x;
    std::uint32_t const y = rays.first.y + i * rays.step.y;
    auto const column = static_cast<std::uint32_t>(std::uint64_t{x} * lattice.cells.x >> 32U);
    auto const row = static_cast<std::uint32_t>(std::uint64_t{y} * lattice.cells.y >> 32U);
    bool const in_doubt = is_near_edge(x * lattice.cells.x, lattice.cells.x) |
                          is_near_edge(y * lattice.cells.y, lattice.cells.y);
    std::uint32_t const word = row * lattice.stride + (column >> 5U);
    places.words[i] = in_doubt ? lattice.unknown : word;
    places.bits[i] = column & 31U;
  }
}

}  // namespace

ImageBounds::ImageBounds(OpacityTile const& image)
    : per_texel(cells_per_texel(image)),
      columns(image.columns() * per_texel),
      rows(image.rows() * per_texel),
      // A word more, for the end of what begins at the last column.
      stride(static_cast<std::size_t>((2 * columns + 2 + word_bits - 1) / word_bits + 1)) {
  auto const count = static_cast<std::size_t>(rows);
  std::vector<std::uint64_t> some(count * stride);
  std::vector<std::uint64_t> solid(count * stride);
  Corners const corners(image, per_texel);
  for (std::size_t row = 0; row < count; ++row) {
    corners.find(static_cast<int>(row), std::span(some).subspan(row * stride, stride),
                 std::span(solid).subspan(row * stride, stride));
  }
  some_solid = joined(some, count, stride, [](auto a, auto b) { return a | b; });
  every_solid = joined(solid, count, stride, [](auto a, auto b) { return a & b; });
}

bool ImageCells::worth(OpacityTile const& image, double rays) {
  constexpr double cells_a_ray = 64.0;
  int const per_texel = cells_per_texel(image);
  return cells_a_ray * rays >=
         static_cast<double>(per_texel) * per_texel * static_cast<double>(image.opacity().size());
}

ImageCells::ImageCells(ImageBounds const& bounds, std::span<glm::dvec2 const> layers)
    : cells_(bounds.columns, bounds.rows) {
  auto const width = static_cast<std::size_t>((bounds.columns + word_bits - 1) / word_bits);
  stride_ = 2 * width;
  words_.resize(static_cast<std::size_t>(bounds.rows) * stride_ + 1);
  std::vector<std::uint64_t> some(width);
  std::vector<std::uint64_t> every(width);
  for (int row = 0; row < bounds.rows; ++row) {
    std::fill(some.begin(), some.end(), 0);
    std::fill(every.begin(), every.end(), 0);
    for (glm::dvec2 const& layer : layers) {
      int const column = static_cast<int>(layer.x * bounds.per_texel) % bounds.columns;
      int const at = (row + static_cast<int>(layer.y * bounds.per_texel)) % bounds.rows;
      std::size_t const word = static_cast<std::size_t>(at) * bounds.stride +
                               static_cast<std::size_t>(column / word_bits);
      auto const bit = static_cast<unsigned>(column % word_bits);
      std::uint64_t const* const some_here = &bounds.some_solid[word];
      std::uint64_t const* const every_here = &bounds.every_solid[word];
      for (std::size_t i = 0; i < width; ++i) some[i] |= bits_from(some_here + i, bit);
      for (std::size_t i = 0; i < width; ++i) every[i] |= bits_from(every_here + i, bit);
    }
    std::uint64_t* const words = &words_[static_cast<std::size_t>(row) * stride_];
    constexpr std::uint64_t low = 0xFFFFFFFFU;
    for (std::size_t i = 0; i < width; ++i) {
      words[2 * i] = (~some[i] & low) | every[i] << 32U;
      words[2 * i + 1] = ~some[i] >> 32U | (every[i] & ~low);
    }
  }
}

ImageCells::Known ImageCells::find(TilePositions const& rays) const {
  Places places;
  run<find_places>(Lattice{cells_, static_cast<std::uint32_t>(stride_),
                           static_cast<std::uint32_t>(words_.size() - 1)},
                   rays, places);
  constexpr std::uint64_t both = 0x1'0000'0001U;
  constexpr std::size_t half = most / 2;
  std::uint64_t low = 0;
  std::uint64_t high = 0;
  for (std::size_t i = 0; i < half; ++i) {
    low |= (words_[places.words[i]] >> places.bits[i] & both) << i;
    high |= (words_[places.words[half + i]] >> places.bits[half + i] & both) << i;
  }
  return {(low & 0xFFFFFFFFU) | high << 32U, low >> 32U | (high & 0xFFFFFFFF00000000U)};
}

}  // namespace gpu_shading
