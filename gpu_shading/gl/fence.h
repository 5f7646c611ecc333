#pragma once

#include <utility>

namespace gpu_shading::gl {

// The device's arrival at where its work stood when this was made. The context has to be current to
// make, ask or end one. Move-only; empty when made by default or moved from.
class Fence {
 public:
  Fence() = default;
  // Sends the work before it to the device.
  static Fence here();

  Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
  }
  Fence(Fence const&) = delete;
  Fence& operator=(Fence const&) = delete;
  ~Fence();

  // Throws DeviceError when the device is lost.
  void wait() const;

 private:
  void* sync_ = nullptr;
};

}  // namespace gpu_shading::gl
