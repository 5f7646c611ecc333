#pragma once

#include <stdexcept>

namespace gpu_shading {

// What went wrong and what to do about it, in one line, ready to be shown to a user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// No device, the wrong device, or a device lost on the way.
class DeviceError : public Error {
 public:
  using Error::Error;
};

}  // namespace gpu_shading
