#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "filters/transmission.h"
#include "geometry/convex_area.h"
#include "view/pixel_mask.h"

namespace gpu_shading {

// How many shades of each kind cover each sample of a tile, or of some rows of it: binary numbers,
// one mask per digit, laid out as a PixelMask is. Takes the time of masks, so that it can have many
// times as many samples as a LuminanceTile. Kinds differ by transmittance or schedule.
class ShadeCounts {
 public:
  // How often each schedule is passed, in the order of schedules.
  using Powers = std::vector<std::pair<int, int>>;
  // The schedules that a sample's beam passes, by number.
  using Combination = std::uint32_t;
  static constexpr Combination unscheduled = 0;

  // No shade anywhere; rows from `first_row` to `end_row` (exclusive).
  void start(int columns, int first_row, int end_row);

  // One more shade.
  void add(ConvexArea const& area, Shade const& shade);
  // To be called after the last.
  void finish();

  bool empty() const { return digits_.empty(); }

  // What passes the shades over some samples of a word: calls use(combination, luminance) for parts
  // of them, where luminance_of(samples) is what they would have without. Throws Error when there
  // are too many combinations.
  template <typename LuminanceOf, typename Use>
  void pass(std::size_t word, std::uint64_t samples, LuminanceOf const& luminance_of,
            Use const& use) {
    pass({word, samples, 0, unscheduled, 1.0}, luminance_of, use);
  }

  std::size_t combinations() const { return combinations_.size(); }
  Powers powers(Combination combination) const;
  int shades(Combination combination) const { return combinations_[combination].shades; }

 private:
  using Words = std::vector<std::uint64_t>;
  struct Kind {
    Shade shade;
    std::vector<Words> digits;  // at least one, the lowest first
  };
  // A digit of a kind's number, with the transmittance of as many shades as it is worth.
  struct Digit {
    std::uint64_t const* words;
    double transmittance;
    int schedule;
    int shades;
  };
  struct OneMore {
    Combination before = unscheduled;
    std::uint32_t digit = 0;
    int shades = 0;  // in all
  };
  // Some samples of a word, from a digit on.
  struct Samples {
    std::size_t word;
    std::uint64_t bits;
    std::size_t digit;
    Combination combination;
    double factor;
  };

  Kind& kind_of(Shade const& shade);
  // Adds to the digits after the lowest.
  void carry_on(Kind& kind, std::size_t word, std::uint64_t carry) const;
  Combination with(Combination combination, std::size_t digit);

  template <typename LuminanceOf, typename Use>
  void pass(Samples some, LuminanceOf const& luminance_of, Use const& use) {
    for (; some.digit < digits_.size(); ++some.digit) {
      Digit const& digit = digits_[some.digit];
      std::uint64_t const covered = some.bits & digit.words[some.word];
      if (covered == 0) continue;
      Samples behind{some.word, covered, some.digit + 1, some.combination,
                     some.factor * digit.transmittance};
      if (digit.schedule != Shade::unscheduled) {
        behind.combination = with(some.combination, some.digit);
      }
      pass(behind, luminance_of, use);
      some.bits &= ~covered;
      if (some.bits == 0) return;
    }
    use(some.combination, some.factor * luminance_of(some.bits));
  }

  int columns_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;  // words of a row
  std::size_t words_ = 0;
  std::vector<Kind> kinds_;
  std::vector<Digit> digits_;
  std::vector<OneMore> combinations_;
  std::vector<Combination> known_;  // by the combination before and the digit; 0: none
};

// Sums luminance by combination.
class CombinationSums {
 public:
  struct Sum {
    ShadeCounts::Combination combination;
    double luminance;
  };

  void add(ShadeCounts::Combination combination, double luminance) {
    if (luminance == 0.0) return;
    if (combination >= sums_.size()) sums_.resize(combination + std::size_t{1});
    double& sum = sums_[combination];
    if (sum == 0.0) met_.push_back(combination);
    sum += luminance;
  }
  // Calls use(combination, luminance) for each, and begins again at 0.
  template <typename Use>
  void take(Use use) {
    for (ShadeCounts::Combination const combination : met_) {
      use(combination, std::exchange(sums_[combination], 0.0));
    }
    met_.clear();
  }

 private:
  std::vector<double> sums_;
  std::vector<ShadeCounts::Combination> met_;
};

}  // namespace gpu_shading
