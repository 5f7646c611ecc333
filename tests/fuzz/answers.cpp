#include <span>
#include <vector>

#include "answers/cache_encoding.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  // As it is, and as what follows the head of a file with the right checksum.
  auto const bytes = std::as_bytes(std::span(data, size));
  constexpr Hash scene{};
  try_to([&] { decode(bytes, scene); });
  auto const empty = encode(SceneAnswers(), scene);
  constexpr std::size_t head = 8 + sizeof(std::uint32_t) + sizeof(Hash);
  std::vector<std::byte> file(empty.begin(), empty.begin() + head);
  file.insert(file.end(), bytes.begin(), bytes.end());
  Digest digest;
  digest.add(std::span<std::byte const>(file));
  auto const checksum = digest.result();
  for (auto const byte : checksum) file.push_back(static_cast<std::byte>(byte));
  return try_to([&] {
    auto const answers = decode(file, scene);
    check_answers(answers, {std::vector<double>(8, 10.0), 4});
    encode(answers, scene);
  });
}
