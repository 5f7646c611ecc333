
#include "fuzz.h"
#include "model/idf/extension_objects.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  auto const text = as_text(data, size);
  bool const json = text.find_first_not_of(" \t\r\n") != text.npos &&
                    text[text.find_first_not_of(" \t\r\n")] == '{';
  return try_to(
      [&] { check_unique(read_side_file(file_of(text, json ? "side.epJSON" : "side.idf"))); });
}
