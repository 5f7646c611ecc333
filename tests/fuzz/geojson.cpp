#include "fuzz.h"
#include "model/site/building_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] {
    read_buildings(file_of(as_text(data, size), "town.geojson"),
                   {"height", "building:levels", 3.0, 10.0}, std::nullopt);
  });
}
