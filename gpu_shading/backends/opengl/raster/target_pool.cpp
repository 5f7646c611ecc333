#include "backends/opengl/raster/target_pool.h"

#include <algorithm>

namespace gpu_shading {

int TargetPool::max_layers(Kind kind, int side) const {
  std::size_t const fit = bounds_.target / layer_bytes(kind, side, summing_);
  return static_cast<int>(
      std::clamp<std::size_t>(fit, 1, static_cast<std::size_t>(bounds_.layers)));
}

Target* TargetPool::take(Kind kind, int side, int layers) {
  Entry* entry = find(kind, side, layers);
  if (entry == nullptr) {
    // A size that was too small before is too small again.
    entries_.remove_if([&](Entry const& other) {
      return !other.taken && other.kind == kind && other.side == side && other.layers < layers;
    });
    std::size_t const bytes = layer_bytes(kind, side, summing_) * static_cast<std::size_t>(layers);
    if (!make_room(bytes)) return nullptr;
    entries_.push_back({kind, side, layers, bytes, make_target(kind, side, layers, summing_)});
    entry = &entries_.back();
  }
  entry->taken = true;
  entry->last_taken = ++taken_;
  return entry->target.get();
}

TargetPool::Entry* TargetPool::find(Kind kind, int side, int layers) {
  // All layers are cleared, so there should not be many unused ones.
  constexpr int spare = 2;
  Entry* found = nullptr;
  for (Entry& entry : entries_) {
    if (entry.taken || entry.kind != kind || entry.side != side) continue;
    if (entry.layers < layers || entry.layers > spare * layers) continue;
    if (found == nullptr || entry.layers < found->layers) found = &entry;
  }
  return found;
}

bool TargetPool::make_room(std::size_t bytes) {
  for (;;) {
    std::size_t all = bytes;
    bool any_taken = false;
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      all += entry->bytes;
      any_taken = any_taken || entry->taken;
      if (entry->taken) continue;
      if (oldest == entries_.end() || entry->last_taken < oldest->last_taken) oldest = entry;
    }
    if (all <= bounds_.all_targets) return true;
    if (oldest == entries_.end()) return !any_taken;
    entries_.erase(oldest);
  }
}

void TargetPool::give_back(Target const* target) {
  for (Entry& entry : entries_) {
    if (entry.target.get() == target) entry.taken = false;
  }
}

void TargetPool::give_all_back() {
  for (Entry& entry : entries_) entry.taken = false;
}

}  // namespace gpu_shading
