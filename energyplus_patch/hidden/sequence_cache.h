#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace gpu_shading::energyplus {

// The bits of a number that is part of a question.
inline std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

// Answers to questions that recur in much the same order, such as those of a loop that is run
// again: an answer is looked for where the last one was found. Questions are compared bit by bit.
// Answers that are no longer wanted in between are passed over, up to a few dozen.
template <std::size_t Words>
class SequenceCache {
 public:
  using Question = std::array<std::uint64_t, Words>;

  // `room`: for how many more answers there is room, here and in others that share it. It must
  // outlive this. Answers without room are not kept.
  explicit SequenceCache(std::size_t& room) : room_(room) {}
  SequenceCache(SequenceCache const&) = delete;
  SequenceCache& operator=(SequenceCache const&) = delete;
  ~SequenceCache() { forget(); }

  // The first question is expected next. Forgets all answers if most of them were of no use.
  void restart() {
    if (missed_ > found_) forget();
    next_ = missed_ = found_ = 0;
  }

  // The answer, until keep() or clear(); nullptr if it is not known.
  double const* find(Question const& question) {
    constexpr std::size_t ahead = 64;
    auto const end = std::min(kept_.size(), next_ + ahead);
    for (std::size_t i = next_; i < end; ++i) {
      if (!same(kept_[i].question, question)) continue;
      next_ = i + 1;
      ++found_;
      return &kept_[i].answer;
    }
    if (next_ < kept_.size()) ++missed_;
    return nullptr;
  }

  // Keeps the answer to the question that was not found, if it came after all that are known and
  // there is memory for it: this is called from within EnergyPlus.
  void keep(Question const& question, double answer) noexcept {
    if (next_ != kept_.size() || room_ == 0) return;
    try {
      kept_.push_back({question, answer});
    } catch (std::bad_alloc const&) {
      return;
    }
    --room_;
    next_ = kept_.size();
  }

  void clear() {
    forget();
    restart();
  }

 private:
  // From behind, where questions that follow each other differ; without a call of memcmp().
  static bool same(Question const& a, Question const& b) {
    for (std::size_t i = Words; i-- > 0;) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }

  void forget() {
    room_ += kept_.size();
    kept_.clear();
  }

  struct Kept {
    Question question;
    double answer;
  };
  std::vector<Kept> kept_;
  std::size_t& room_;
  std::size_t next_ = 0;
  std::size_t found_ = 0;
  std::size_t missed_ = 0;
};

}  // namespace gpu_shading::energyplus
