#include "model/input/pv_reductions.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  ShadingInput input;
  input.shading_surfaces["ROW"] = {};
  return try_to(
      [&] { read_pv_reductions(file_of(as_text(data, size), "reductions.csv"), {}, input); });
}
