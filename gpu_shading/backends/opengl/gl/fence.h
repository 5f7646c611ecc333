#pragma once

#include <utility>

namespace gpu_shading::gl {

// Signals when the device has done the work submitted before its creation. Creating, querying and
// destroying it require the current context. Move-only; empty when default-constructed or moved
// from.
class Fence {
 public:
  Fence() = default;
  // Submits the work before it to the device.
  static Fence here();

  Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
  }
  Fence(Fence const&) = delete;
  Fence& operator=(Fence const&) = delete;
  ~Fence();

  // Throws DeviceError if the device is lost.
  void wait() const;

 private:
  void* sync_ = nullptr;
};

}  // namespace gpu_shading::gl
