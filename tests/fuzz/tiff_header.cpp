// Our reading of TIFF with libtiff and of GeoTIFF's keys: sizes, strips and small texels.

#include <exception>

#include "files/image_decoder/elevations.h"
#include "files/image_decoder/images.h"
#include "files/image_decoder/tiff.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading;
  auto const path = energyplus::file_of(energyplus::as_text(data, size), "hill.tif");
  try {
    auto const small = decoding::read_small_tiff(path.c_str(), false);
    constexpr std::uint32_t most = 1024;
    if (small && small->width <= most && small->height <= most) {
      auto const whole = decoding::read_small_tiff(path.c_str(), true);
      energyplus::require(whole->texels.size() == std::size_t{small->width} * small->height);
    }
  } catch (std::exception const&) {
  }
  try {
    auto const [header, elevations] = decoding::read_elevations(path.c_str());
    auto const cells =
        static_cast<std::size_t>(header.columns) * static_cast<std::size_t>(header.rows);
    energyplus::require(elevations.empty() || elevations.size() == cells);
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}
