#include "answers/answer_errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace gpu_shading::energyplus {
namespace {

// Keeps the exponent and seven bits of the mantissa, so that few errors differ.
float rounded_up(double error) {
  constexpr std::uint32_t dropped = 0xffff;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(static_cast<float>(error)) + dropped) &
                              ~dropped);
}

}  // namespace

void AnswerErrors::add(SurfaceId receiver, std::optional<double> error) {
  if (error == 0.0) {
    ++exact_;
    return;
  }
  auto& of_receiver = of_receivers_[receiver];
  if (!error) {
    ++not_measured_;
    of_receiver.all_measured = false;
    return;
  }
  ++sampled_;
  ++counts_[rounded_up(*error)];
  of_receiver.largest = std::max(of_receiver.largest, *error);
}

AnswerErrors& AnswerErrors::operator+=(AnswerErrors const& other) {
  sampled_ += other.sampled_;
  exact_ += other.exact_;
  not_measured_ += other.not_measured_;
  for (auto const& [error, count] : other.counts_) counts_[error] += count;
  for (auto const& [id, theirs] : other.of_receivers_) {
    auto& ours = of_receivers_[id];
    ours.largest = std::max(ours.largest, theirs.largest);
    ours.all_measured = ours.all_measured && theirs.all_measured;
  }
  return *this;
}

double AnswerErrors::largest() const {
  double largest = Sunlit::rounding;
  for (auto const& [id, each] : of_receivers_) largest = std::max(largest, each.largest);
  return largest;
}

double AnswerErrors::within(double share) const {
  auto left = std::ceil(share * static_cast<double>(sampled_));
  for (auto const& [error, count] : counts_) {
    left -= static_cast<double>(count);
    if (left <= 0.0) return std::min(double{error}, largest());
  }
  return largest();
}

double AnswerErrors::largest_of(SurfaceId receiver) const {
  auto const found = of_receivers_.find(receiver);
  return found == of_receivers_.end() ? OfReceiver{}.largest : found->second.largest;
}

bool AnswerErrors::all_measured_of(SurfaceId receiver) const {
  auto const found = of_receivers_.find(receiver);
  return found == of_receivers_.end() || found->second.all_measured;
}

}  // namespace gpu_shading::energyplus
