#include "files/image_decoder/tiff_file.h"

#include <geotiff.h>
#include <xtiffio.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <stdexcept>

namespace gpu_shading::decoding {
namespace {

struct FreeOptions {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

int keep_error(TIFF* /*file*/, void* message, char const* /*module*/, char const* format,
               va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(message) = text.data();
  return 1;
}

int keep_quiet(TIFF* /*file*/, void* /*data*/, char const* /*module*/, char const* /*format*/,
               va_list /*arguments*/) {
  return 1;
}

}  // namespace

void TiffFile::Close::operator()(TIFF* file) const { XTIFFClose(file); }

TiffFile::TiffFile(char const* path) : error_(std::make_unique<std::string>()) {
  XTIFFInitialize();
  std::unique_ptr<TIFFOpenOptions, FreeOptions> const options(TIFFOpenOptionsAlloc());
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, error_.get());
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
  file_.reset(TIFFOpenExt(path, "r", options.get()));
  if (!file_) throw std::runtime_error(error_->empty() ? "is not a TIFF" : *error_);
}

}  // namespace gpu_shading::decoding
