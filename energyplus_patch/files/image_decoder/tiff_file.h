#pragma once

#include <tiffio.h>

#include <memory>
#include <string>

namespace gpu_shading::decoding {

// An open TIFF whose library prints nothing.
class TiffFile {
 public:
  // Throws std::runtime_error.
  explicit TiffFile(char const* path);

  TIFF* get() const { return file_.get(); }

  // The library's last error, or "".
  std::string const& error() const { return *error_; }

 private:
  struct Close {
    void operator()(TIFF* file) const;
  };

  std::unique_ptr<std::string> error_;  // at one address, which the library keeps
  std::unique_ptr<TIFF, Close> file_;
};

}  // namespace gpu_shading::decoding
