#pragma once

#include <unistd.h>

namespace gpu_shading::energyplus {

// A duplicate of standard error, which a child process inherits; none on Windows, where programs
// inherit no descriptors.
class StandardError {
 public:
#ifdef _WIN32
  StandardError() = default;
#else
  StandardError() : descriptor_(dup(STDERR_FILENO)) {}
#endif
  ~StandardError() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  StandardError(StandardError const&) = delete;
  StandardError& operator=(StandardError const&) = delete;

  int descriptor() const { return descriptor_; }  // -1: none

 private:
  int descriptor_ = -1;
};

}  // namespace gpu_shading::energyplus
