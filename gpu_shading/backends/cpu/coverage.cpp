#include "backends/cpu/coverage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

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

// Some rows of samples behind casters.
class ShadedRows {
 public:
  // All dark. `counted`: as for Coverage::rows(). `luminous`: unless they are, samples may keep a
  // part of the beam.
  void start(TileGrid const& grid, int first, int end, bool counted, bool luminous) {
    lit_.start(grid.columns(), first, end);
    counts_.start(grid.columns(), first, end);
    counted_ = counted;
    luminous_ = luminous;
    if (counted) return;
    if (luminous) {
      luminance_.start(grid.columns(), first, end);
    } else {
      luminance_.lay_out(grid.columns(), first, end);
    }
  }

  PixelMask& lit() { return lit_; }
  LuminanceTile& luminance() { return luminance_; }

  void dim(ConvexArea const& area, Shade shade) {
    if (!counted_) {
      luminance_.multiply(area, shade.transmittance);
      if (shade.schedule == Shade::unscheduled) return;
      shade.transmittance = 1.0F;
    }
    counts_.add(area, shade);
  }
  // To be called once all casters have been.
  void finish() { counts_.finish(); }

  // Calls use(combination, luminance) for the samples whose bits are set in some words, of which
  // this is the first.
  template <typename Use>
  void sum(std::size_t first, std::span<std::uint64_t const> of, Use use) {
    std::span<std::uint64_t const> const lit = lit_.words().subspan(first, of.size());
    if (counts_.empty() && !luminous_) {
      return use(ShadeCounts::unscheduled, static_cast<double>(count_common(lit, of)));
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      std::uint64_t const samples = lit[i] & of[i];
      if (samples == 0) continue;
      if (luminous_) {
        auto const luminance = [&](std::uint64_t some) { return luminance_.sum(first + i, some); };
        counts_.pass(first + i, samples, luminance, use);
      } else {
        counts_.pass(
            first + i, samples, [](std::uint64_t some) { return count(some); }, use);
      }
    }
  }

  ShadeCounts const& counts() const { return counts_; }

 private:
  static double count(std::uint64_t samples) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    return samples == all ? double{PixelMask::word_bits} : std::popcount(samples);
  }

  PixelMask lit_;
  ShadeCounts counts_;
  LuminanceTile luminance_;
  bool counted_ = true;
  bool luminous_ = false;
};

// The sums of rows, of which threads add some at a time.
class SumOfRows {
 public:
  SumOfRows(std::size_t rows, std::size_t parts, bool scheduled)
      : parts_(parts), scheduled_(scheduled) {
    sums_.own.resize(rows);
    sums_.lit.assign(scheduled ? measured_factors * parts : parts, std::vector<double>(rows));
  }

  // Some rows that one thread adds.
  struct Share {
    struct Sum {
      std::size_t part;
      ShadeCounts::Combination combination;
      double luminance;
    };
    std::vector<Sum> scheduled;
    std::vector<ShadeCounts::Powers> powers;  // by combination
  };

  std::span<double> own() { return sums_.own; }

  // What is lit of a part in a row, in some words of it.
  void add(Share& share, ShadedRows& rows, std::size_t part, std::size_t row,
           std::size_t first_word, std::span<std::uint64_t const> of) {
    if (!scheduled_) {
      double& lit = sums_.lit[part][row];
      return rows.sum(first_word, of,
                      [&](ShadeCounts::Combination, double luminance) { lit += luminance; });
    }
    static thread_local CombinationSums sums;
    rows.sum(first_word, of, [](ShadeCounts::Combination combination, double luminance) {
      sums.add(combination, luminance);
    });
    sums.take([&](ShadeCounts::Combination combination, double luminance) {
      int const shades = rows.counts().shades(combination);
      std::array<double, measured_factors> const passed{shades == 0 ? luminance : 0.0,
                                                        std::ldexp(luminance, -shades), luminance};
      for (std::size_t i = 0; i < passed.size(); ++i) {
        sums_.lit[i * parts_ + part][row] += passed.at(i);
      }
      if (shades > 0) share.scheduled.push_back({part, combination, luminance});
    });
  }
  void add(Share share, ShadedRows const& rows, int first_row) {
    if (!scheduled_) return;
    for (std::size_t i = 0; i < rows.counts().combinations(); ++i) {
      share.powers.push_back(rows.counts().powers(static_cast<ShadeCounts::Combination>(i)));
    }
    std::lock_guard const lock(mutex_);
    shares_.emplace(first_row, std::move(share));
  }

  // In the order of rows, so that they are the same on any number of threads.
  RowSums take() {
    if (!scheduled_) return std::move(sums_);
    std::vector<std::map<ShadeCounts::Powers, double>> totals(parts_);
    for (auto const& [first_row, share] : shares_) {
      std::vector<double*> known(parts_ * share.powers.size());
      for (auto const& [part, combination, luminance] : share.scheduled) {
        double*& total = known[part * share.powers.size() + combination];
        if (total == nullptr) total = &totals[part][share.powers[combination]];
        *total += luminance;
      }
    }
    for (auto const& of_part : totals) {
      auto& scheduled = sums_.scheduled.emplace_back();
      for (auto const& [powers, sum] : of_part) scheduled.push_back({powers, sum});
    }
    return std::move(sums_);
  }

 private:
  std::size_t parts_;
  bool scheduled_;
  RowSums sums_;
  std::mutex mutex_;
  std::map<int, Share> shares_;  // by first row
};

}  // namespace

bool can_be_counted(CastersInView const& casters) {
  if (!casters.bodies.empty()) return false;
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

struct Coverage::InteriorPiece {
  std::size_t surface;  // its index in the question
  ConvexArea area;
  DepthPlane depth;
};

// Some rows of a mask, few enough that the masks of all pieces there stay in a processor's cache.
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

  std::size_t first_word = 0;  // of the mask's words
  std::size_t words = 0;
  std::vector<Part> kept;  // with their memory, from one band to the next
  std::size_t count = 0;
};

template <typename Use>
void Coverage::each_area(int side, View const& pixels, CastersInView const& casters,
                         Range const& some, Use use) const {
  for (std::size_t i = some.first; i < some.first + some.count; ++i) {
    Shade const shade = casters.shades.empty() ? Shade{} : casters.shades[i];
    pieces_.each(casters.surfaces[i], pixels,
                 [&](ProjectedPiece const& piece) { use(piece.area(side), shade); });
  }
}

std::vector<std::vector<ShadedArea>> Coverage::areas(int side, View const& pixels,
                                                     CastersInView const& casters,
                                                     int threads) const {
  constexpr std::size_t at_once = 256;
  std::size_t const count = casters.surfaces.size();
  std::vector<std::vector<ShadedArea>> found((count + at_once - 1) / at_once);
  for_each_of(found.size(), threads, [&](std::size_t i) {
    Range const some{i * at_once, std::min(at_once, count - i * at_once)};
    found[i].reserve(some.count);
    each_area(side, pixels, casters, some, [&](ConvexArea const& area, Shade const& shade) {
      if (area.first_row < area.end_row) found[i].push_back({area, shade});
    });
  });
  return found;
}

template <typename Dim>
void Coverage::cover(PixelMask& mask, int side, View const& pixels, CastersInView const& casters,
                     Dim dim) const {
  auto const put = [&](ConvexArea const& area, Shade const& shade) {
    if (shade.transmittance > 0.0F) {
      dim(area, shade);
    } else {
      mask.darken(area);
    }
  };
  if (casters.areas.empty()) {
    return each_area(side, pixels, casters, {0, casters.surfaces.size()}, put);
  }
  for (std::vector<ShadedArea> const& some : casters.areas) {
    for (auto const& [area, shade] : some) {
      if (area.first_row < mask.end_row() && area.end_row > mask.first_row()) put(area, shade);
    }
  }
}

void Coverage::shade(PixelMask& mask, LuminanceTile& shaded, View const& pixels,
                     CastersInView const& casters) const {
  cover(mask, std::max(shaded.columns(), mask.end_row()), pixels, casters,
        [&](ConvexArea const& area, Shade const& shade) {
          shaded.multiply(area, shade.transmittance);
        });
  casters.bodies.shade(shaded, mask, pixels);
}

void Coverage::darken(PixelMask& mask, SampledView const& view, CastersInView const& casters,
                      int threads) const {
  auto const& [receiver, towards_sun] = casters.question;
  LitCrowds::Key const key{receiver, towards_sun, view.slope, view.grid, mask.first_row()};
  if (casters.known != nullptr && casters.known->take(key, mask)) return;
  casters.crowd->darken(mask, view.grid.side(), view.in_front, casters.question, threads);
  if (casters.known != nullptr) casters.known->keep(key, mask);
}

RowSums Coverage::rows(SampledView const& view, CastersInView const& given, bool counted,
                       int threads) const {
  int const rows = view.grid.mask_rows();
  int const side = view.grid.side();
  CastersInView casters = given;
  // Projected once for several parts of the rows.
  std::vector<std::vector<ShadedArea>> projected;
  if (casters.crowd == nullptr && rows_a_part(rows, threads) < rows) {
    projected = areas(side, view.in_front, casters, threads);
    casters.areas = projected;
  }
  bool const luminous =
      !counted && (any_transmits(casters.shades) || !casters.bodies.all_or_nothing(view.in_front));
  std::vector<InteriorPiece> const pieces = interior_pieces(view);
  SumOfRows sums(static_cast<std::size_t>(rows), view.through ? view.interiors.size() : 1,
                 any_scheduled(casters.shades));
  // A crowd is shared by its casters.
  in_rows(rows, casters.crowd != nullptr ? 1 : threads, [&](int first, int end) {
    static thread_local ShadedRows rows_behind;
    ShadedRows& shaded = rows_behind;
    shaded.start(view.grid, first, end, counted, luminous);
    PixelMask& lit = shaded.lit();
    for (ConvexArea const& area : view.outline) lit.light(area);
    auto const first_row = static_cast<std::size_t>(first);
    lit.count_rows(sums.own().subspan(first_row));
    if (casters.crowd != nullptr) {
      darken(lit, view, casters, threads);
    } else {
      cover(lit, side, view.in_front, casters,
            [&](ConvexArea const& area, Shade const& shade) { shaded.dim(area, shade); });
      casters.bodies.shade(shaded.luminance(), lit, view.in_front);
    }
    shaded.finish();
    SumOfRows::Share share;
    std::size_t const stride = lit.words().size() / static_cast<std::size_t>(end - first);
    auto const add = [&](std::size_t part, std::size_t first_word,
                         std::span<std::uint64_t const> of) {
      for (std::size_t word = 0; word < of.size(); word += stride) {
        sums.add(share, shaded, part, first_row + (first_word + word) / stride, first_word + word,
                 of.subspan(word, stride));
      }
    };
    if (view.through) {
      each_band(lit, pieces, [&](Band const& band) {
        for (Band::Part const& part : band.parts()) {
          add(part.piece->surface, band.first_word, part.mask.words());
        }
      });
    } else {
      add(0, 0, std::as_const(lit).words());
    }
    sums.add(std::move(share), shaded, first);
  });
  return sums.take();
}

std::vector<Coverage::InteriorPiece> Coverage::interior_pieces(SampledView const& view) const {
  std::vector<InteriorPiece> found;
  for (std::size_t i = 0; i < view.interiors.size(); ++i) {
    pieces_.each(view.interiors[i], view.behind, [&](ProjectedPiece const& piece) {
      found.push_back({i, piece.area(view.grid.side()), piece.depth()});
    });
  }
  return found;
}

template <typename Use>
void Coverage::each_band(PixelMask const& lit, std::span<InteriorPiece const> pieces, Use use) {
  constexpr std::size_t max_words = 4096;
  static thread_local Band band;
  static thread_local std::vector<std::uint64_t> covered;
  static thread_local std::vector<std::uint64_t> several;
  std::size_t const words_a_row =
      lit.words().size() / static_cast<std::size_t>(lit.end_row() - lit.first_row());
  int const rows = std::max(1, static_cast<int>(max_words / words_a_row));
  band.first_word = 0;
  for (int first = lit.first_row(); first < lit.end_row(); first += rows) {
    int const end = std::min(first + rows, lit.end_row());
    band.words = static_cast<std::size_t>(end - first) * words_a_row;
    band.count = 0;
    covered.assign(band.words, 0);
    several.assign(band.words, 0);
    for (InteriorPiece const& piece : pieces) {
      if (piece.area.first_row >= end || piece.area.end_row <= first) continue;
      if (band.count == band.kept.size()) band.kept.emplace_back();
      Band::Part& added = band.kept[band.count++];
      added.piece = &piece;
      added.mask.start(lit.columns(), first, end);
      added.mask.light(piece.area);
      std::span<std::uint64_t const> const words = std::as_const(added.mask).words();
      for (std::size_t k = 0; k < words.size(); ++k) {
        several[k] |= covered[k] & words[k];
        covered[k] |= words[k];
      }
    }
    // In a closed room, two surfaces hardly ever cover the same pixel.
    std::span<std::uint64_t const> const lit_words =
        lit.words().subspan(band.first_word, band.words);
    for (std::size_t word = 0; word < several.size(); ++word) {
      for (std::uint64_t rest = several[word] & lit_words[word]; rest != 0; rest &= rest - 1) {
        keep_nearest(band, word, std::countr_zero(rest));
      }
    }
    use(std::as_const(band));
    band.first_word += band.words;
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
