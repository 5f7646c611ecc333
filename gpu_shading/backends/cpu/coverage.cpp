#include "backends/cpu/coverage.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "antialias/antialias.h"
#include "backends/cpu/shade_counts.h"
#include "platform/parallel.h"

namespace gpu_shading {
namespace {

bool any_scheduled(std::span<Shade const> shades) {
  return std::any_of(shades.begin(), shades.end(),
                     [](Shade const& shade) { return shade.schedule != Shade::unscheduled; });
}

bool any_transmits(std::span<Shade const> shades) {
  return std::any_of(shades.begin(), shades.end(),
                     [](Shade const& shade) { return shade.transmittance > 0.0F; });
}

// Whether shades are of few transmittances, which ShadeCounts takes, and nothing else is in view.
bool can_be_counted(CastersInView const& casters) {
  if (casters.opaque() || !casters.bodies.empty()) return false;
  if (any_scheduled(casters.shades)) return false;
  constexpr std::size_t most = 6;
  std::array<float, most> kinds{};
  std::size_t count = 0;
  for (Shade const& shade : casters.shades) {
    auto const end = kinds.begin() + static_cast<std::ptrdiff_t>(count);
    if (shade.transmittance == 0.0F) continue;
    if (std::find(kinds.begin(), end, shade.transmittance) != end) continue;
    if (count == most) return false;
    kinds.at(count++) = shade.transmittance;
  }
  return true;
}

// Places of casters in the order of their schedules.
std::vector<std::size_t> by_schedule(std::span<Shade const> shades) {
  std::vector<std::size_t> order(shades.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shades[a].schedule < shades[b].schedule;
  });
  return order;
}

// Calls use(word, bit) for the set bits of some words, in order.
template <typename Use>
void each_bit(std::uint64_t word, std::size_t number, Use use) {
  for (std::uint64_t rest = word; rest != 0; rest &= rest - 1) {
    use(number * PixelMask::word_bits + static_cast<std::size_t>(std::countr_zero(rest)));
  }
}

// The rows of each part, of which so many threads may take one at a time.
int rows_a_part(int rows, int threads) {
  // The largest tiles would take too much memory at once.
  constexpr int most = 2048;
  return std::clamp((rows - 1) / std::max(threads, 1) + 1, 1, most);
}

// Calls use(i) for every i below `count`, on one thread or on all.
template <typename Use>
void for_each_of(std::size_t count, int threads, Use const& use) {
  if (threads > 1) return for_each_index(count, use);
  for (std::size_t i = 0; i < count; ++i) use(i);
}

// Calls use(first, end) for parts of a number of rows, on at most this many threads.
template <typename Use>
void in_rows(int rows, int threads, Use use) {
  int const share = rows_a_part(rows, threads);
  for_each_of(static_cast<std::size_t>((rows + share - 1) / share), threads, [&](std::size_t part) {
    int const first = static_cast<int>(part) * share;
    use(first, std::min(first + share, rows));
  });
}

// Where a view is sampled.
TileGrid sampled(Tile const& tile, View const& view, CastersInView const& casters, Samples samples,
                 SampleUse use) {
  if (samples == Samples::pixels) return pixels_of(tile);
  if (casters.grid) return *casters.grid;
  return sample_grid(tile, view, casters.bodies.screens, casters.repeats, use);
}

// From samples to pixels of the tile, if so many samples are the receiver's.
void scale(LuminanceSums& sums, Tile const& tile, double samples) {
  // Multiplied first: exactly all pixels where all samples are sunlit.
  auto const pixels = static_cast<double>(tile.counted_pixels);
  sums.unscheduled = sums.unscheduled * pixels / samples;
  for (LuminanceSums::Scheduled& part : sums.scheduled) part.sum = part.sum * pixels / samples;
}

}  // namespace

SampleUse sample_use(CastersInView const& casters) {
  if (casters.opaque()) return SampleUse::coverage;
  return can_be_counted(casters) ? SampleUse::counting : SampleUse::luminance;
}

struct Coverage::InteriorPiece {
  std::size_t surface;  // its index in the question
  ConvexArea area;
  DepthPlane depth;
};

// Some rows of a tile, few enough that the masks of all pieces there stay in a processor's cache.
struct Coverage::Band {
  struct Part {
    InteriorPiece const* piece = nullptr;
    PixelMask mask;  // of the band's rows

    double depth_at(std::size_t word, int bit) const {
      return piece->depth.at(mask.column(word) + bit, mask.row(word));
    }
  };

  std::span<Part> parts() { return std::span(kept).first(count); }
  std::span<Part const> parts() const { return std::span(kept).first(count); }
  std::span<std::uint64_t const> rows_of(PixelMask const& mask) const {
    return mask.words().subspan(first_word, words);
  }

  std::size_t first_word = 0;  // of the tile's words
  std::size_t words = 0;
  std::size_t rows = 0;
  std::vector<Part> kept;  // with their memory, from one band to the next
  std::size_t count = 0;
};

template <typename Use>
void Coverage::each_area(int side, View const& pixels, CastersInView const& casters,
                         std::span<std::size_t const> order, Range const& positions,
                         Use use) const {
  for (std::size_t i = positions.first; i < positions.first + positions.count; ++i) {
    std::size_t const place = order.empty() ? i : order[i];
    Shade const shade = casters.shades.empty() ? Shade{} : casters.shades[place];
    pieces_.each(casters.surfaces[place], pixels,
                 [&](ProjectedPiece const& piece) { use(piece.area(side), shade); });
  }
}

std::vector<std::vector<ShadedArea>> Coverage::areas(int side, View const& pixels,
                                                     CastersInView const& casters,
                                                     std::span<std::size_t const> order,
                                                     int threads) const {
  constexpr std::size_t at_once = 256;
  std::size_t const count = casters.surfaces.size();
  std::vector<std::vector<ShadedArea>> found((count + at_once - 1) / at_once);
  for_each_of(found.size(), threads, [&](std::size_t i) {
    Range const positions{i * at_once, std::min(at_once, count - i * at_once)};
    found[i].reserve(positions.count);
    each_area(side, pixels, casters, order, positions,
              [&](ConvexArea const& area, Shade const& shade) {
                if (area.first_row < area.end_row) found[i].push_back({area, shade});
              });
  });
  return found;
}

template <typename Dim>
void Coverage::cover(PixelMask& mask, int side, View const& pixels, CastersInView const& casters,
                     std::span<std::size_t const> order, Dim dim) const {
  auto const put = [&](ConvexArea const& area, Shade const& shade) {
    if (shade.transmittance > 0.0F) {
      dim(area, shade);
    } else {
      mask.darken(area);
    }
  };
  if (casters.areas.empty()) {
    return each_area(side, pixels, casters, order, {0, casters.surfaces.size()}, put);
  }
  for (std::vector<ShadedArea> const& some : casters.areas) {
    for (auto const& [area, shade] : some) {
      if (area.first_row < mask.end_row() && area.end_row > mask.first_row()) put(area, shade);
    }
  }
}

void Coverage::shade(PixelMask& mask, LuminanceTile& shaded, PassedSchedules* passed,
                     View const& pixels, CastersInView const& casters) const {
  std::vector<std::size_t> order;
  if (passed != nullptr && casters.areas.empty()) order = by_schedule(casters.shades);
  cover(mask, std::max(shaded.columns(), mask.end_row()), pixels, casters, order,
        [&](ConvexArea const& area, Shade const& shade) {
          shaded.multiply(area, shade.transmittance);
          if (shade.schedule != Shade::unscheduled) passed->pass(area, shade.schedule);
        });
  casters.bodies.shade(shaded, mask, pixels);
}

void Coverage::darken(PixelMask& mask, Tile const& tile, TileGrid const& grid, View const& pixels,
                      CastersInView const& casters, int threads) const {
  if (casters.crowd == nullptr) {
    return cover(mask, grid.side(), pixels, casters, {}, [](ConvexArea const&, Shade const&) {});
  }
  auto const& [receiver, towards_sun] = casters.question;
  LitCrowds::Key const key{receiver, towards_sun, tile.lay.slope, grid, mask.first_row()};
  if (casters.known != nullptr && casters.known->take(key, mask)) return;
  casters.crowd->darken(mask, grid.side(), pixels, casters.question, threads);
  if (casters.known != nullptr) casters.known->keep(key, mask);
}

// Sums over a grid's samples, row by row. `own` takes the number of those that are the receiver's.
struct Coverage::Rows {
  Coverage const& coverage;
  Tile const& tile;
  TileGrid const& grid;
  View pixels;
  CastersInView const& casters;
  int threads;

  // Calls use(mask, first, end) for parts of the rows, in any order and by any threads, with the
  // receiver's samples lit. `own` takes the number of these by row.
  template <typename Use>
  void each(std::vector<double>& own, Use use) const {
    own.resize(static_cast<std::size_t>(grid.mask_rows()));
    // A crowd is shared by its casters.
    int const shares = casters.crowd != nullptr ? 1 : threads;
    in_rows(grid.mask_rows(), shares, [&](int first, int end) {
      static thread_local PixelMask mask;
      mask.start(grid.columns(), first, end);
      light(mask, tile, grid);
      mask.count_rows(std::span(own).subspan(static_cast<std::size_t>(first)));
      use(mask, first, end);
    });
  }

  // With sums of rows: calls use(mask, first, end, sums).
  template <typename Use>
  RowSums sum_rows(Use use) const {
    RowSums sums;
    std::vector<double>& lit = sums.lit.emplace_back(static_cast<std::size_t>(grid.mask_rows()));
    each(sums.own, [&](PixelMask& mask, int first, int end) {
      use(mask, first, end, std::span(lit).subspan(static_cast<std::size_t>(first)));
    });
    return sums;
  }

  RowSums lit() const {
    return sum_rows([&](PixelMask& mask, int /*first*/, int /*end*/, std::span<double> sums) {
      coverage.darken(mask, tile, grid, pixels, casters, threads);
      mask.count_rows(sums);
    });
  }

  RowSums counted() const {
    return sum_rows([&](PixelMask& mask, int first, int end, std::span<double> sums) {
      static thread_local ShadeCounts counts;
      counts.start(grid.columns(), first, end);
      coverage.cover(mask, grid.side(), pixels, casters, {},
                     [&](ConvexArea const& area, Shade const& shade) {
                       counts.add(area, shade.transmittance);
                     });
      counts.sum_rows(mask, sums);
    });
  }

  RowSums luminance() const {
    bool const darkening = !any_transmits(casters.shades) && casters.bodies.all_or_nothing(pixels);
    return sum_rows([&](PixelMask& mask, int first, int end, std::span<double> sums) {
      static thread_local LuminanceTile shaded;
      if (darkening) {
        shaded.lay_out(grid.columns(), first, end);
      } else {
        shaded.start(grid.columns(), first, end);
      }
      coverage.shade(mask, shaded, nullptr, pixels, casters);
      if (darkening) {
        mask.count_rows(sums);
      } else {
        shaded.sum_rows(mask, sums);
      }
    });
  }

  LuminanceSums scheduled(std::vector<double>& own) const {
    struct Part {
      PassedSchedules passed;
      std::vector<CombinationSums::Sum> row_sums;
    };
    std::mutex parts_mutex;
    std::map<int, Part> parts;  // by first row
    each(own, [&](PixelMask& mask, int first, int end) {
      static thread_local LuminanceTile shaded;
      Part part;
      shaded.start(grid.columns(), first, end);
      part.passed.start(grid.columns(), first, end);
      coverage.shade(mask, shaded, &part.passed, pixels, casters);
      CombinationSums sums(part.passed.combinations());
      std::span<std::uint64_t const> const words = std::as_const(mask).words();
      std::size_t const words_a_row = shaded.stride() / PixelMask::word_bits;
      for (std::size_t word = 0; word < words.size(); ++word) {
        each_bit(words[word], word, [&](std::size_t pixel) {
          sums.add(part.passed.pixels()[pixel], std::as_const(shaded).pixels()[pixel]);
        });
        if ((word + 1) % words_a_row == 0) sums.take(part.row_sums);
      }
      std::lock_guard const lock(parts_mutex);
      parts.emplace(first, std::move(part));
    });
    ScheduledTotals totals;
    for (auto const& [first, part] : parts) totals.add(part.passed, part.row_sums);
    return totals.result();
  }

  RowSums unscheduled(SampleUse use) const {
    if (use == SampleUse::coverage) return lit();
    return use == SampleUse::counting ? counted() : luminance();
  }
};

// Casters in a view with its x and y in pixels, projected once for several parts of the rows.
struct Coverage::Projected {
  Projected(Coverage const& coverage, TileGrid const& grid, View const& in_pixels,
            CastersInView const& in_view, int threads)
      : pixels(in_pixels), casters(in_view) {
    int const rows = grid.mask_rows();
    if (casters.crowd != nullptr || rows_a_part(rows, threads) == rows) return;
    std::vector<std::size_t> order;
    if (any_scheduled(casters.shades)) order = by_schedule(casters.shades);
    areas = coverage.areas(grid.side(), pixels, casters, order, threads);
    casters.areas = areas;
  }

  View pixels;
  CastersInView casters;
  std::vector<std::vector<ShadedArea>> areas;
};

LuminanceSums Coverage::sums(Tile const& tile, View const& view, CastersInView const& casters,
                             Samples samples, int threads) const {
  // Pixels are too few to be worth counting.
  SampleUse const use =
      samples == Samples::pixels && !casters.opaque() ? SampleUse::luminance : sample_use(casters);
  TileGrid const grid = sampled(tile, view, casters, samples, use);
  Projected const projected(*this, grid, in_pixels(view, grid), casters, threads);
  Rows const rows{*this, tile, grid, projected.pixels, projected.casters, threads};
  LuminanceSums sums;
  std::vector<double> own;
  if (any_scheduled(casters.shades)) {
    sums = rows.scheduled(own);
  } else {
    RowSums by_row = rows.unscheduled(use);
    sums.unscheduled = total(by_row.lit.front());
    own = std::move(by_row.own);
  }
  double const of_receiver = total(own);
  // Rows may all miss a small receiver that pixels meet.
  if (of_receiver == 0.0) return this->sums(tile, view, casters, Samples::pixels, threads);
  scale(sums, tile, of_receiver);
  return sums;
}

RowSums Coverage::rows(TileGrid const& grid, Tile const& tile, View const& view,
                       CastersInView const& casters, SampleUse use, int threads) const {
  Projected const projected(*this, grid, in_pixels(view, grid), casters, threads);
  return Rows{*this, tile, grid, projected.pixels, projected.casters, threads}.unscheduled(use);
}

void Coverage::add_lit(PixelMask const& lit, Band const& band,
                       std::span<std::vector<double>> sums) {
  std::size_t const stride = band.words / band.rows;
  std::span<std::uint64_t const> const lit_words = band.rows_of(lit);
  for (Band::Part const& part : band.parts()) {
    std::vector<double>& of_surface = sums[part.piece->surface];
    for (std::size_t row = 0; row < band.rows; ++row) {
      std::uint64_t const count = count_common(lit_words.subspan(row * stride, stride),
                                               part.mask.words().subspan(row * stride, stride));
      of_surface[band.first_word / stride + row] += static_cast<double>(count);
    }
  }
}

void Coverage::add_luminance(PixelMask const& lit, LuminanceTile const& shaded,
                             PassedSchedules const& passed, Band const& band,
                             std::span<ScheduledTotals> totals) {
  CombinationSums by_combination(passed.combinations());
  std::vector<CombinationSums::Sum> taken;
  std::span<std::uint64_t const> const words = band.rows_of(lit);
  for (Band::Part const& part : band.parts()) {
    for (std::size_t word = 0; word < words.size(); ++word) {
      each_bit(words[word] & part.mask.words()[word], band.first_word + word,
               [&](std::size_t pixel) {
                 by_combination.add(passed.pixels()[pixel], shaded.pixels()[pixel]);
               });
    }
    taken.clear();
    by_combination.take(taken);
    totals[part.piece->surface].add(passed, taken);
  }
}

std::vector<LuminanceSums> Coverage::sums_inside(Tile const& tile, View const& view,
                                                 CastersInView const& casters, Samples samples,
                                                 View const& behind,
                                                 std::span<SurfaceId const> interiors) const {
  TileGrid const grid = sampled(tile, view, casters, samples, sample_use(casters));
  std::vector<LuminanceSums> sums(interiors.size());
  double own = 0.0;
  if (casters.opaque()) {
    RowSums const by_row = rows_inside(grid, tile, view, casters, behind, interiors);
    own = total(by_row.own);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i].unscheduled = total(by_row.lit[i]);
  } else {
    static thread_local PixelMask lit;
    static thread_local LuminanceTile shaded;
    static thread_local PassedSchedules passed;
    int const rows = grid.mask_rows();
    lit.start(grid.columns(), 0, rows);
    light(lit, tile, grid);
    own = static_cast<double>(lit.lit());
    shaded.start(grid.columns(), 0, rows);
    passed.start(grid.columns(), 0, rows);
    shade(lit, shaded, &passed, in_pixels(view, grid), casters);
    std::vector<ScheduledTotals> totals(interiors.size());
    each_band(grid, lit, interior_pieces(grid, in_pixels(behind, grid), interiors),
              [&](Band const& band) { add_luminance(lit, shaded, passed, band, totals); });
    std::transform(totals.begin(), totals.end(), sums.begin(),
                   [](ScheduledTotals const& total) { return total.result(); });
  }
  if (own == 0.0) return sums_inside(tile, view, casters, Samples::pixels, behind, interiors);
  for (LuminanceSums& part : sums) scale(part, tile, own);
  return sums;
}

RowSums Coverage::rows_inside(TileGrid const& grid, Tile const& tile, View const& view,
                              CastersInView const& casters, View const& behind,
                              std::span<SurfaceId const> interiors) const {
  static thread_local PixelMask lit;
  auto const rows = static_cast<std::size_t>(grid.mask_rows());
  RowSums sums;
  sums.own.resize(rows);
  sums.lit.assign(interiors.size(), std::vector<double>(rows));
  lit.start(grid.columns(), 0, grid.mask_rows());
  light(lit, tile, grid);
  lit.count_rows(sums.own);
  darken(lit, tile, grid, in_pixels(view, grid), casters, 1);
  each_band(grid, lit, interior_pieces(grid, in_pixels(behind, grid), interiors),
            [&](Band const& band) { add_lit(lit, band, sums.lit); });
  return sums;
}

std::vector<Coverage::InteriorPiece> Coverage::interior_pieces(
    TileGrid const& grid, View const& pixels, std::span<SurfaceId const> interiors) const {
  std::vector<InteriorPiece> found;
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    pieces_.each(interiors[i], pixels, [&](ProjectedPiece const& piece) {
      found.push_back({i, piece.area(grid.side()), piece.depth()});
    });
  }
  return found;
}

template <typename Use>
void Coverage::each_band(TileGrid const& grid, PixelMask const& lit,
                         std::span<InteriorPiece const> pieces, Use use) {
  constexpr std::size_t max_words = 4096;
  static thread_local Band band;
  static thread_local std::vector<std::uint64_t> covered;
  static thread_local std::vector<std::uint64_t> several;
  std::size_t const words_a_row = lit.words().size() / static_cast<std::size_t>(grid.mask_rows());
  int const rows = std::max(1, static_cast<int>(max_words / words_a_row));
  for (int first = 0; first < grid.mask_rows(); first += rows) {
    int const end = std::min(first + rows, grid.mask_rows());
    band.first_word = static_cast<std::size_t>(first) * words_a_row;
    band.rows = static_cast<std::size_t>(end - first);
    band.words = band.rows * words_a_row;
    band.count = 0;
    covered.assign(band.words, 0);
    several.assign(band.words, 0);
    for (InteriorPiece const& piece : pieces) {
      if (piece.area.first_row >= end || piece.area.end_row <= first) continue;
      if (band.count == band.kept.size()) band.kept.emplace_back();
      Band::Part& added = band.kept[band.count++];
      added.piece = &piece;
      added.mask.start(grid.columns(), first, end);
      added.mask.light(piece.area);
      std::span<std::uint64_t const> const words = std::as_const(added.mask).words();
      for (std::size_t k = 0; k < words.size(); ++k) {
        several[k] |= covered[k] & words[k];
        covered[k] |= words[k];
      }
    }
    // In a closed room, two surfaces hardly ever cover the same pixel.
    std::span<std::uint64_t const> const lit_words = band.rows_of(lit);
    for (std::size_t word = 0; word < several.size(); ++word) {
      for (std::uint64_t rest = several[word] & lit_words[word]; rest != 0; rest &= rest - 1) {
        keep_nearest(band, word, std::countr_zero(rest));
      }
    }
    use(std::as_const(band));
  }
}

void Coverage::keep_nearest(Band& band, std::size_t word, int bit) {
  std::uint64_t const pixel = std::uint64_t{1} << static_cast<unsigned>(bit);
  std::uint64_t* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Band::Part& part : band.parts()) {
    std::uint64_t& pixels = part.mask.words()[word];
    if ((pixels & pixel) == 0) continue;
    double const depth = part.depth_at(word, bit);
    if (nearest != nullptr && !(depth < least)) {
      pixels &= ~pixel;
      continue;
    }
    if (nearest != nullptr) *nearest &= ~pixel;
    nearest = &pixels;
    least = depth;
  }
}

}  // namespace gpu_shading
