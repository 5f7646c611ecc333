#pragma once

#include <unistd.h>

namespace gpu_shading::energyplus {

// A duplicate of standard error, which a child process inherits.
class StandardError {
 public:
  StandardError() : descriptor_(dup(STDERR_FILENO)) {}
  ~StandardError() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  StandardError(StandardError const&) = delete;
  StandardError& operator=(StandardError const&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace gpu_shading::energyplus
