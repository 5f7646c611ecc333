#include "fuzz.h"
#include "model/site/building_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  auto const path = file_of(as_text(data, size), "town.gpkg");
  HeightRule const heights{"height", "building:levels", 3.0, 10.0};
  try_to([&] {
    read_buildings(path, heights, std::nullopt, geojson::Nearby{{47.0, 8.0, 0.0}, 300.0});
  });
  return try_to([&] { read_buildings(path, heights, std::nullopt); });
}
