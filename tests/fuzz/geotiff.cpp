
#include "fuzz.h"
#include "model/site/terrain_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] {
    auto const path = file_of(as_text(data, size), "hill.tif");
    if (is_tiff(path)) read_terrain(path, gpu_shading::MapCoordinates());
  });
}
