#include "tasks/view_list.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] { read_views(file_of(as_text(data, size), "views.txt")); });
}
