#include "raster_cpu/coverage.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <utility>

#include "raster_cpu/screen_grid.h"
#include "raster_cpu/shade_counts.h"
#include "threads/parallel.h"

namespace gpu_shading {
namespace {

View in_pixels(View view, TileGrid const& grid) {
  glm::dvec4 const shift(0.0, 0.0, 0.0, 1.0);
  view.x = 0.5 * grid.width * (view.x + shift);
  view.y = 0.5 * grid.rows * (view.y + shift);
  view.x += grid.shear * view.y;
  return view;
}

bool any_scheduled(std::span<Shade const> shades) {
  return std::any_of(shades.begin(), shades.end(),
                     [](Shade const& shade) { return shade.schedule != Shades::unscheduled; });
}

bool any_transmits(std::span<Shade const> shades) {
  return std::any_of(shades.begin(), shades.end(),
                     [](Shade const& shade) { return shade.transmittance > 0.0F; });
}

// With so many columns to each row.
TileGrid golden_grid(int rows, int columns_a_row) {
  constexpr double golden = 1.0 / std::numbers::phi;
  double const slope = columns_a_row * golden;
  return {columns_a_row * rows, rows, std::ceil(slope) - slope - (1.0 - golden)};
}

// Where shades are counted, which takes longer than covering: the rows of the fine grid.
TileGrid counting_grid(Tile const& tile) { return golden_grid(fine_grid(tile).rows, 4); }

// Whether shades are of few transmittances, which ShadeCounts takes, and nothing else is in view.
bool can_be_counted(CastersInView const& casters) {
  if (casters.opaque() || !casters.screens.numbers.empty()) return false;
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

// Calls use(first, end) for parts of a number of rows, on at most this many threads.
template <typename Use>
void in_rows(int rows, int threads, Use use) {
  if (threads <= 1) return use(0, rows);
  int const share = (rows + threads - 1) / threads;
  for_each_index(static_cast<std::size_t>((rows + share - 1) / share), [&](std::size_t part) {
    int const first = static_cast<int>(part) * share;
    use(first, std::min(first + share, rows));
  });
}

TileGrid grid_of(Tile const& tile, View const& view, CastersInView const& casters,
                 Samples samples) {
  if (samples == Samples::pixels) return pixels_of(tile);
  if (casters.opaque()) return fine_grid(tile);
  if (casters.screens.numbers.empty()) return pixels_of(tile);
  return screen_grid(tile, view, casters.screens);
}

// From samples to pixels of the tile, if `own` samples are the receiver's.
void scale(LuminanceSums& sums, Tile const& tile, std::uint64_t own) {
  // Multiplied first: exactly all pixels where all samples are sunlit.
  auto const pixels = static_cast<double>(tile.counted_pixels);
  auto const samples = static_cast<double>(own);
  sums.unscheduled = sums.unscheduled * pixels / samples;
  for (LuminanceSums::Scheduled& part : sums.scheduled) part.sum = part.sum * pixels / samples;
}

}  // namespace

TileGrid fine_grid(Tile const& tile) {
  constexpr int large = 128;  // smaller tiles have too few edges to alias with 9 columns to a row
  int const rows = std::max((tile.side + 1) / 2, std::min(tile.side, 96 + tile.side * 3 / 8));
  return golden_grid(rows, tile.side < large ? 9 : 17);
}

struct Coverage::InteriorPiece {
  std::size_t surface = 0;  // its index in the question
  PixelMask mask;
  DepthPlane depth;

  double depth_at(std::size_t word, int bit) const {
    return depth.at(mask.column(word) + bit, mask.row(word));
  }
};

template <typename Use>
void Coverage::each_area(SurfaceId caster, View const& pixels, int side, Use use) const {
  pieces_.each(caster, pixels, [&](ProjectedPiece const& piece) { use(piece.area(side)); });
}

LuminanceSums Coverage::sums(Tile const& tile, View const& view, CastersInView const& casters,
                             Samples samples, int threads) const {
  bool const counting = samples == Samples::fine && can_be_counted(casters);
  TileGrid const grid = counting ? counting_grid(tile) : grid_of(tile, view, casters, samples);
  View const pixels = in_pixels(view, grid);
  std::atomic<std::uint64_t> own = 0;
  LuminanceSums sums;
  if (casters.opaque()) {
    sums.unscheduled = lit(tile, grid, pixels, casters.surfaces, threads, own);
  } else if (counting) {
    sums.unscheduled = counted(tile, grid, pixels, casters, threads, own);
  } else if (any_scheduled(casters.shades)) {
    sums = scheduled(tile, grid, pixels, casters, threads, own);
  } else {
    sums.unscheduled = luminance(tile, grid, pixels, casters, threads, own);
  }
  // Rows may all miss a small receiver that pixels meet.
  if (own == 0) return this->sums(tile, view, casters, Samples::pixels, threads);
  scale(sums, tile, own);
  return sums;
}

void Coverage::darken(PixelMask& mask, int side, View const& pixels,
                      std::span<SurfaceId const> casters) const {
  for (SurfaceId const id : casters) {
    each_area(id, pixels, side, [&](ConvexArea const& area) { mask.darken(area); });
  }
}

void Coverage::shade(PixelMask& mask, LuminanceTile& shaded, PassedSchedules* passed,
                     View const& pixels, CastersInView const& casters) const {
  if (casters.opaque()) return darken(mask, shaded.columns(), pixels, casters.surfaces);
  auto const shade_by = [&](std::size_t i) {
    Shade const& shade = casters.shades[i];
    each_area(casters.surfaces[i], pixels, shaded.columns(), [&](ConvexArea const& area) {
      if (shade.transmittance > 0.0F) {
        shaded.multiply(area, shade.transmittance);
        if (shade.schedule != Shades::unscheduled) passed->pass(area, shade.schedule);
      } else {
        mask.darken(area);
      }
    });
  };
  if (passed == nullptr) {
    for (std::size_t i = 0; i < casters.shades.size(); ++i) shade_by(i);
  } else {
    for (std::size_t const i : by_schedule(casters.shades)) shade_by(i);
  }
  shade_by_screens(shaded, mask, pixels, casters.screens);
}

double Coverage::lit(Tile const& tile, TileGrid const& grid, View const& pixels,
                     std::span<SurfaceId const> casters, int threads,
                     std::atomic<std::uint64_t>& own) const {
  std::atomic<std::uint64_t> sum = 0;
  in_rows(grid.rows, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    mask.start(grid.columns(), first, end);
    light(mask, tile, grid);
    own += mask.lit();
    darken(mask, grid.side(), pixels, casters);
    sum += mask.lit();
  });
  return static_cast<double>(sum);
}

double Coverage::luminance(Tile const& tile, TileGrid const& grid, View const& pixels,
                           CastersInView const& casters, int threads,
                           std::atomic<std::uint64_t>& own) const {
  bool const darkening = !any_transmits(casters.shades) && all_or_nothing(casters.screens, pixels);
  std::vector<double> sums(static_cast<std::size_t>(grid.rows));
  in_rows(grid.rows, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    static thread_local LuminanceTile shaded;
    mask.start(grid.columns(), first, end);
    light(mask, tile, grid);
    own += mask.lit();
    if (darkening) {
      shaded.lay_out(grid.columns(), first, end);
    } else {
      shaded.start(grid.columns(), first, end);
    }
    shade(mask, shaded, nullptr, pixels, casters);
    std::span const rows = std::span(sums).subspan(static_cast<std::size_t>(first));
    if (darkening) {
      rows[0] = static_cast<double>(mask.lit());
    } else {
      shaded.sum_rows(mask, rows);
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double Coverage::counted(Tile const& tile, TileGrid const& grid, View const& pixels,
                         CastersInView const& casters, int threads,
                         std::atomic<std::uint64_t>& own) const {
  std::vector<double> sums(static_cast<std::size_t>(grid.rows));
  in_rows(grid.rows, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    static thread_local ShadeCounts counts;
    mask.start(grid.columns(), first, end);
    light(mask, tile, grid);
    own += mask.lit();
    counts.start(grid.columns(), first, end);
    for (std::size_t i = 0; i < casters.shades.size(); ++i) {
      float const transmittance = casters.shades[i].transmittance;
      each_area(casters.surfaces[i], pixels, grid.side(), [&](ConvexArea const& area) {
        if (transmittance > 0.0F) {
          counts.add(area, transmittance);
        } else {
          mask.darken(area);
        }
      });
    }
    counts.sum_rows(mask, std::span(sums).subspan(static_cast<std::size_t>(first)));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

LuminanceSums Coverage::scheduled(Tile const& tile, TileGrid const& grid, View const& pixels,
                                  CastersInView const& casters, int threads,
                                  std::atomic<std::uint64_t>& own) const {
  // Rows are summed one by one and added up in order, however threads share them.
  struct Part {
    int first;
    PassedSchedules passed;
    std::vector<CombinationSums::Sum> row_sums;
  };
  std::mutex parts_mutex;
  std::vector<Part> parts;
  in_rows(grid.rows, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    static thread_local LuminanceTile shaded;
    Part part{first, {}, {}};
    mask.start(grid.columns(), first, end);
    light(mask, tile, grid);
    own += mask.lit();
    shaded.start(grid.columns(), first, end);
    part.passed.start(grid.columns(), first, end);
    shade(mask, shaded, &part.passed, pixels, casters);
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
    parts.push_back(std::move(part));
  });
  std::sort(parts.begin(), parts.end(),
            [](Part const& a, Part const& b) { return a.first < b.first; });
  ScheduledTotals totals;
  for (Part const& part : parts) totals.add(part.passed, part.row_sums);
  return totals.result();
}

std::vector<LuminanceSums> Coverage::lit_inside(PixelMask const& lit,
                                                std::span<InteriorPiece const> pieces,
                                                std::size_t interiors) {
  std::vector<std::uint64_t> counts(interiors);
  for (InteriorPiece const& piece : pieces) {
    counts[piece.surface] += count_common(lit.words(), piece.mask.words());
  }
  std::vector<LuminanceSums> sums;
  sums.reserve(counts.size());
  for (std::uint64_t const count : counts) sums.push_back({static_cast<double>(count), {}});
  return sums;
}

std::vector<LuminanceSums> Coverage::luminance_inside(PixelMask const& lit,
                                                      LuminanceTile const& shaded,
                                                      PassedSchedules const& passed,
                                                      std::span<InteriorPiece const> pieces,
                                                      std::size_t interiors) {
  CombinationSums by_combination(passed.combinations());
  std::vector<CombinationSums::Sum> taken;
  std::vector<ScheduledTotals> totals(interiors);
  std::span<std::uint64_t const> const words = lit.words();
  for (InteriorPiece const& piece : pieces) {
    for (std::size_t word = 0; word < words.size(); ++word) {
      each_bit(words[word] & piece.mask.words()[word], word, [&](std::size_t pixel) {
        by_combination.add(passed.pixels()[pixel], shaded.pixels()[pixel]);
      });
    }
    taken.clear();
    by_combination.take(taken);
    totals[piece.surface].add(passed, taken);
  }
  std::vector<LuminanceSums> sums;
  sums.reserve(totals.size());
  for (ScheduledTotals const& total : totals) sums.push_back(total.result());
  return sums;
}

std::vector<LuminanceSums> Coverage::sums_inside(Tile const& tile, View const& view,
                                                 CastersInView const& casters, Samples samples,
                                                 View const& behind,
                                                 std::span<SurfaceId const> interiors) const {
  TileGrid const grid = grid_of(tile, view, casters, samples);
  View const pixels = in_pixels(view, grid);
  PixelMask lit;
  lit.start(grid.columns(), 0, grid.rows);
  light(lit, tile, grid);
  std::uint64_t const own = lit.lit();
  if (own == 0) return sums_inside(tile, view, casters, Samples::pixels, behind, interiors);
  std::vector<LuminanceSums> sums;
  if (casters.opaque()) {
    darken(lit, grid.side(), pixels, casters.surfaces);
    sums = lit_inside(lit, find_inside(grid, in_pixels(behind, grid), interiors, lit),
                      interiors.size());
  } else {
    LuminanceTile shaded;
    PassedSchedules passed;
    shaded.start(grid.columns(), 0, grid.rows);
    passed.start(grid.columns(), 0, grid.rows);
    shade(lit, shaded, &passed, pixels, casters);
    sums = luminance_inside(lit, shaded, passed,
                            find_inside(grid, in_pixels(behind, grid), interiors, lit),
                            interiors.size());
  }
  for (LuminanceSums& part : sums) scale(part, tile, own);
  return sums;
}

std::vector<Coverage::InteriorPiece> Coverage::find_inside(TileGrid const& grid, View const& pixels,
                                                           std::span<SurfaceId const> interiors,
                                                           PixelMask const& lit) const {
  std::vector<InteriorPiece> found;
  std::vector<std::uint64_t> covered(lit.words().size());
  std::vector<std::uint64_t> several(lit.words().size());
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    pieces_.each(interiors[i], pixels, [&](ProjectedPiece const& piece) {
      ConvexArea const area = piece.area(grid.side());
      if (area.first_row >= area.end_row) return;
      InteriorPiece& added = found.emplace_back();
      added.surface = i;
      added.depth = piece.depth();
      added.mask.start(grid.columns(), 0, grid.rows);
      added.mask.light(area);
      std::span<std::uint64_t const> const words = std::as_const(added.mask).words();
      for (std::size_t k = 0; k < words.size(); ++k) {
        several[k] |= covered[k] & words[k];
        covered[k] |= words[k];
      }
    });
  }
  // In a closed room, two surfaces hardly ever cover the same pixel.
  for (std::size_t word = 0; word < several.size(); ++word) {
    for (std::uint64_t rest = several[word] & lit.words()[word]; rest != 0; rest &= rest - 1) {
      keep_nearest(found, word, std::countr_zero(rest));
    }
  }
  return found;
}

void Coverage::keep_nearest(std::span<InteriorPiece> pieces, std::size_t word, int bit) {
  std::uint64_t const pixel = std::uint64_t{1} << static_cast<unsigned>(bit);
  InteriorPiece* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (InteriorPiece& piece : pieces) {
    std::uint64_t& pixels = piece.mask.words()[word];
    if ((pixels & pixel) == 0) continue;
    double const depth = piece.depth_at(word, bit);
    if (nearest != nullptr && !(depth < least)) {
      pixels &= ~pixel;
      continue;
    }
    if (nearest != nullptr) nearest->mask.words()[word] &= ~pixel;
    nearest = &piece;
    least = depth;
  }
}

}  // namespace gpu_shading
