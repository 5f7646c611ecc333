#include "backends/cpu/lit_crowds.h"

#include <algorithm>

namespace gpu_shading {
namespace {

constexpr std::size_t max_words = std::size_t{4} << 20U;
constexpr std::size_t max_kept = 1024;

}  // namespace

bool LitCrowds::take(Key const& key, PixelMask& lit) {
  std::lock_guard const lock(mutex_);
  auto const found = std::ranges::find(kept_, key, &std::pair<Key, PixelMask>::first);
  if (found == kept_.end()) return false;
  words_ -= found->second.words().size();
  lit = std::move(found->second);
  kept_.erase(found);
  return true;
}

void LitCrowds::keep(Key const& key, PixelMask const& lit) {
  std::lock_guard const lock(mutex_);
  words_ += lit.words().size();
  kept_.emplace_back(key, lit);
  while (words_ > max_words || kept_.size() > max_kept) {
    words_ -= kept_.front().second.words().size();
    kept_.pop_front();
  }
}

}  // namespace gpu_shading
