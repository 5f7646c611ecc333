#include "fuzz.h"
#include "model/idf/model_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  auto const text = as_text(data, size);
  // The syntax is EnergyPlus's, which takes any text.
  auto const parsed = parse_idf(text);
  rewrite_idf(text, parsed, {shading_method("PixelCounting", "Timestep")});
  return try_to([&] { read_idf(parsed); });
}
