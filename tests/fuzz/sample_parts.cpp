#include "tasks/samples/sample_parts.h"

#include <fmt/format.h>

#include "fuzz.h"
#include "scene/digest.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  // What follows the checksum of a part, which is made right.
  auto const text = as_text(data, size);
  Digest digest;
  digest.add(text);
  auto const part = fmt::format("{{\"xxh128\":\"{}\",{}\n", to_text(digest.result()), text);
  auto const path = file_of(part, "round1-shard1of1.json");
  return try_to([&] {
    SampleParts const parts(path.parent_path(), 1);
    if (auto const found = parts.find(1, 1)) parts.write(*found);
  });
}
