#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Renderers of one scene, for each position of its moving shades that was asked for. The least
// recently used ones are closed.
class MovedRenderers {
 public:
  using Positions = std::vector<double>;
  using Open = std::function<Renderer(Positions const&, DeviceId const&)>;

  // `resting`: with the shades at `rest`. `open`: needed only if other positions are asked for.
  MovedRenderers(Renderer resting, Positions rest, Open open)
      : resting_(std::make_unique<Renderer>(std::move(resting))),
        rest_(std::move(rest)),
        open_(std::move(open)) {}

  Renderer& at_rest() { return *resting_; }
  Renderer const& at_rest() const { return *resting_; }

  // Valid until the next call. Throws what `open` throws.
  Renderer& at(Positions const& positions) {
    if (positions == rest_) return *resting_;
    auto found = moved_.find(positions);
    if (found == moved_.end()) {
      // The CPU also if it took over from a GPU.
      auto const device = resting_->device().id;
      if (moved_.size() >= (device.is_cpu() ? max_renderers : max_on_gpu)) close_oldest();
      found = moved_.emplace(positions, Moved{std::make_unique<Renderer>(open_(positions, device))})
                  .first;
    }
    found->second.used = ++uses_;
    return *found->second.renderer;
  }

  RendererStatistics statistics() const {
    auto sum = closed_;
    sum += resting_->statistics();
    for (auto const& [positions, moved] : moved_) sum += moved.renderer->statistics();
    return sum;
  }

 private:
  static constexpr std::size_t max_renderers = 200;
  static constexpr std::size_t max_on_gpu = 16;  // each has a context, and targets in its memory
  struct Moved {
    std::unique_ptr<Renderer> renderer;
    std::uint64_t used = 0;
  };

  void close_oldest() {
    auto oldest = moved_.begin();
    for (auto each = moved_.begin(); each != moved_.end(); ++each) {
      if (each->second.used < oldest->second.used) oldest = each;
    }
    closed_ += oldest->second.renderer->statistics();
    moved_.erase(oldest);
  }

  std::unique_ptr<Renderer> resting_;
  Positions rest_;
  Open open_;
  std::map<Positions, Moved> moved_;
  std::uint64_t uses_ = 0;
  RendererStatistics closed_;
};

}  // namespace gpu_shading::energyplus
