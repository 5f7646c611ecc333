#include "fuzz.h"
#include "model/site/terrain_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] { read_terrain(file_of(as_text(data, size), "hill.asc"), std::nullopt); });
}
