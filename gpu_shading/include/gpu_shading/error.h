#pragma once

#include <stdexcept>

namespace gpu_shading {

// The cause and the remedy in one line that can be shown to a user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// There is no device, it is unsuitable, or it was lost.
class DeviceError : public Error {
 public:
  using Error::Error;
};

}  // namespace gpu_shading
