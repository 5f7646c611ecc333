#pragma once

#include <cstdint>
#include <utility>

namespace gpu_shading::gl {

// Owner of one GL object; move-only. Empty (name 0) when default-constructed or moved from.
// Creating and destroying it require the current context. `Destroy` deletes the object with a name.
template <void (*Destroy)(std::uint32_t)>
class Object {
 public:
  Object() = default;
  Object(Object const&) = delete;
  Object& operator=(Object const&) = delete;
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Object() {
    if (name_ != 0) Destroy(name_);
  }

  std::uint32_t name() const { return name_; }
  bool empty() const { return name_ == 0; }

 protected:
  explicit Object(std::uint32_t name) : name_(name) {}

 private:
  std::uint32_t name_ = 0;
};

}  // namespace gpu_shading::gl
