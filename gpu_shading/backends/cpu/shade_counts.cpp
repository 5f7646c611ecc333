#include "backends/cpu/shade_counts.h"

#include <algorithm>
#include <bit>

namespace gpu_shading {
namespace {

constexpr unsigned word_bits = PixelMask::word_bits;
constexpr std::uint64_t all = ~std::uint64_t{0};

// A digit of a kind's number, with the transmittance of as many shades as it is worth.
struct Digit {
  std::uint64_t const* words;
  double transmittance;
};

// The luminance of some samples of a word, from a digit on.
double passed(std::span<Digit const> digits, std::size_t word, std::uint64_t samples) {
  double factor = 1.0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    std::uint64_t const covered = samples & digits[i].words[word];
    if (covered == 0) continue;
    if (covered != samples) {
      std::span<Digit const> const rest = digits.subspan(i + 1);
      return factor * (digits[i].transmittance * passed(rest, word, covered) +
                       passed(rest, word, samples & ~covered));
    }
    factor *= digits[i].transmittance;
  }
  return factor * (samples == all ? double{word_bits} : std::popcount(samples));
}

}  // namespace

void ShadeCounts::start(int columns, int first_row, int end_row) {
  columns_ = columns;
  first_row_ = first_row;
  end_row_ = end_row;
  stride_ = (static_cast<std::size_t>(columns) + word_bits - 1) / word_bits;
  words_ = static_cast<std::size_t>(end_row - first_row) * stride_;
  kinds_.clear();
}

ShadeCounts::Kind& ShadeCounts::kind_of(float transmittance) {
  auto const found = std::find_if(kinds_.begin(), kinds_.end(), [&](Kind const& kind) {
    return kind.transmittance == transmittance;
  });
  if (found != kinds_.end()) return *found;
  return kinds_.emplace_back(Kind{transmittance, {Words(words_)}});
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

void ShadeCounts::add(ConvexArea const& area, float transmittance) {
  Kind& kind = kind_of(transmittance);
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

void ShadeCounts::sum_rows(PixelMask const& lit, std::span<double> sums) const {
  std::vector<Digit> digits;
  for (Kind const& kind : kinds_) {
    double transmittance = static_cast<double>(kind.transmittance);
    for (Words const& words : kind.digits) {
      digits.push_back({words.data(), transmittance});
      transmittance *= transmittance;
    }
  }
  std::span<std::uint64_t const> const words = lit.words();
  for (std::size_t word = 0; word < words.size(); ++word) {
    if (words[word] != 0) sums[word / stride_] += passed(digits, word, words[word]);
  }
}

}  // namespace gpu_shading
