// Images through the decoding process, as a run reads them: whatever its libraries do with the
// file, what comes back is an image or one Error.

#include <array>

#include "files/image_file.h"
#include "fuzz.h"

// The first byte chooses the ending of the file's name, and whether every format is read.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  if (size == 0) return 0;
  constexpr std::array names{"a.png", "a.jpg", "a.tif", "a.exr", "a.bmp",
                             "a.tga", "a.hdr", "a.ico", "a.dds", "a.iff"};
  constexpr std::uint8_t any = 0x10;
  auto const assets = (data[0] & any) != 0 ? Assets::any : Assets::restricted;
  auto const path = file_of(as_text(data + 1, size - 1), names.at(data[0] % any % names.size()));
  return try_to([&] {
    auto const info = probe_texture(path, assets);
    constexpr int most = 4096;
    if (info.width > most || info.height > most) return;
    auto const texels =
        static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height);
    require(read_opacity(path, info, assets).size() == texels);
  });
}
