#include "fuzz.h"
#include "gpu_shading/transmittance.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] { gpu_shading::read_angular_csv(file_of(as_text(data, size), "glass.csv")); });
}
