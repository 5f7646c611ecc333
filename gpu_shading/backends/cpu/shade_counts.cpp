#include "backends/cpu/shade_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

constexpr unsigned word_bits = PixelMask::word_bits;
constexpr std::uint64_t all = ~std::uint64_t{0};

// Each takes 12 bytes, and 4 for each digit.
constexpr std::size_t max_combinations = std::size_t{1} << 22U;

}  // namespace

void ShadeCounts::start(int columns, int first_row, int end_row) {
  columns_ = columns;
  first_row_ = first_row;
  end_row_ = end_row;
  stride_ = (static_cast<std::size_t>(columns) + word_bits - 1) / word_bits;
  words_ = static_cast<std::size_t>(end_row - first_row) * stride_;
  kinds_.clear();
  digits_.clear();
  combinations_.assign(1, {});
  known_.clear();
}

ShadeCounts::Kind& ShadeCounts::kind_of(Shade const& shade) {
  auto const found = std::ranges::find(kinds_, shade, &Kind::shade);
  if (found != kinds_.end()) return *found;
  return kinds_.emplace_back(Kind{shade, {Words(words_)}});
}

void ShadeCounts::carry_on(Kind& kind, std::size_t word, std::uint64_t carry) const {
  for (std::size_t digit = 1; carry != 0; ++digit) {
    if (digit == kind.digits.size()) kind.digits.emplace_back(words_);
    std::uint64_t& bits = kind.digits[digit][word];
    std::uint64_t const sum = bits ^ carry;
    carry &= bits;
    bits = sum;
  }
}

void ShadeCounts::add(ConvexArea const& area, Shade const& shade) {
  Kind& kind = kind_of(shade);
  std::uint64_t* const lowest = kind.digits.front().data();
  auto const add_to = [&](std::size_t word, std::uint64_t samples) {
    std::uint64_t const carry = lowest[word] & samples;
    lowest[word] ^= samples;
    if (carry != 0) carry_on(kind, word, carry);
  };
  each_span(area, columns_, first_row_, end_row_, [&](int row, int from, int count) {
    auto const first = static_cast<unsigned>(from);
    auto const length = static_cast<unsigned>(count);
    unsigned const shift = first % word_bits;
    std::size_t word = static_cast<std::size_t>(row - first_row_) * stride_ + first / word_bits;
    unsigned const end = shift + length;
    if (end <= word_bits) return add_to(word, all >> (word_bits - length) << shift);
    add_to(word, all << shift);
    unsigned rest = end - word_bits;
    for (; rest > word_bits; rest -= word_bits) add_to(++word, all);
    add_to(++word, all >> (word_bits - rest));
  });
}

void ShadeCounts::finish() {
  // By kind, so that sums do not depend on the order of casters. Schedules first: most samples have
  // few combinations of them.
  std::ranges::sort(kinds_, [](Kind const& a, Kind const& b) {
    return std::pair(b.shade.schedule, a.shade.transmittance) <
           std::pair(a.shade.schedule, b.shade.transmittance);
  });
  for (Kind const& kind : kinds_) {
    double transmittance = static_cast<double>(kind.shade.transmittance);
    int shades = 1;
    for (Words const& words : kind.digits) {
      digits_.push_back({words.data(), transmittance, kind.shade.schedule, shades});
      transmittance *= transmittance;
      shades *= 2;
    }
  }
  known_.assign(digits_.size(), unscheduled);
}

ShadeCounts::Combination ShadeCounts::with(Combination combination, std::size_t digit) {
  std::size_t const place = combination * digits_.size() + digit;
  if (known_[place] != unscheduled) return known_[place];
  if (combinations_.size() >= max_combinations) {
    throw Error(
        fmt::format("sees the sun through more than {} combinations of transmittance schedules; "
                    "let shades share schedules",
                    max_combinations));
  }
  auto const added = static_cast<Combination>(combinations_.size());
  known_[place] = added;
  combinations_.push_back({combination, static_cast<std::uint32_t>(digit),
                           combinations_[combination].shades + digits_[digit].shades});
  known_.resize(known_.size() + digits_.size(), unscheduled);
  return added;
}

ShadeCounts::Powers ShadeCounts::powers(Combination combination) const {
  Powers powers;
  for (; combination != unscheduled; combination = combinations_[combination].before) {
    Digit const& digit = digits_[combinations_[combination].digit];
    if (powers.empty() || powers.back().first != digit.schedule) {
      powers.emplace_back(digit.schedule, 0);
    }
    powers.back().second += digit.shades;
  }
  return powers;
}

}  // namespace gpu_shading
