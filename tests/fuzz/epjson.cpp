#include "fuzz.h"
#include "model/idf/model_file.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  return try_to([&] {
    auto model = parse_epjson(as_text(data, size));
    read_epjson(model);
    if (model.is_object()) rewrite_epjson(model, {shading_method("PixelCounting", "Timestep")});
  });
}
