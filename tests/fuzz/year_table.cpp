#include "tasks/samples/year_table.h"

#include <sstream>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  std::istringstream csv{std::string(as_text(data, size))};
  return try_to([&] { read_hours_of_21st(csv); });
}
