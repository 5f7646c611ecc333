#pragma once

#include <unistd.h>

namespace gpu_shading::energyplus {

// Closes a file descriptor with the object; a negative one, as calls that fail return, is none.
class FileDescriptor {
 public:
  explicit FileDescriptor(int value) : value_(value) {}
  FileDescriptor(FileDescriptor const&) = delete;
  FileDescriptor& operator=(FileDescriptor const&) = delete;
  ~FileDescriptor() {
    if (value_ >= 0) close(value_);
  }

  bool is_open() const { return value_ >= 0; }
  int get() const { return value_; }

 private:
  int value_;
};

}  // namespace gpu_shading::energyplus
