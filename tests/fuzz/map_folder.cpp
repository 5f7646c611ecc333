#include "reports/map_folder.h"

#include "fuzz.h"

// The same bytes as each of the files that a report reads of a folder of maps.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  auto const text = as_text(data, size);
  try_to([&] { read_map_array(file_of(text, "wall.npy")); });
  try_to([&] {
    auto const list = file_of(text, "maps.csv");
    file_of("{\"from\": \"01-01\", \"to\": \"12-31\"}", "maps.json");
    read_map_folder(list.parent_path());
  });
  return try_to([&] { read_map_folder(file_of(text, "maps.json").parent_path()); });
}
