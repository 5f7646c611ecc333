// What is read of an image before OpenImageIO opens it.

#include "files/image_decoder/image_format.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::decoding;
  auto const path =
      gpu_shading::energyplus::file_of(gpu_shading::energyplus::as_text(data, size), "picture");
  for (auto const* name : {"picture.PNG", "picture.tga", "picture", "picture.gif"}) {
    try {
      gpu_shading::energyplus::require(!restricted_format(path.c_str(), name).empty());
    } catch (std::exception const&) {
      continue;
    }
  }
  try {
    bmp_has_alpha(path.c_str());
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}
