#include "files/image_file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "files/decoding_process.h"
#include "files/image_decoder/images.h"
#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"

namespace gpu_shading::energyplus {
namespace {

// `max_texels`: the texels of an image that is read as a whole.
TextureInfo read(char const* operation, std::int64_t max_texels, std::filesystem::path const& path,
                 Assets assets) {
  require_file(path);
  return naming(fmt::format("{}: cannot be read", path.string()), [&] {
    constexpr int largest = std::numeric_limits<int>::max();
    DecodingProcess decoding("gpu_shading_image_decoder", operation, path, assets);
    TextureInfo info;
    info.width = decoding.next<std::int32_t>(1, largest);
    info.height = decoding.next<std::int32_t>(1, largest);
    info.channels = decoding.next<std::int32_t>(1, largest);
    info.alpha = decoding.next<std::int32_t>(0, 1) == 1;
    auto const all = std::int64_t{info.width} * info.height;
    auto const expected = all > max_texels ? 0 : static_cast<std::uint64_t>(all);
    decoding.next<std::uint64_t>(expected, expected);
    info.opacity = decoding.next_all<std::uint16_t>(expected);
    decoding.finish();
    return info;
  });
}

}  // namespace

TextureInfo probe_texture(std::filesystem::path const& path, Assets assets) {
  auto info = read("small image", decoding::few_texels, path, assets);
  if (info.width > max_texture_side || info.height > max_texture_side) {
    throw Error(fmt::format("{}: is {} x {} texels, expected at most {} per side", path.string(),
                            info.width, info.height, max_texture_side));
  }
  return info;
}

std::vector<std::uint16_t> read_opacity(std::filesystem::path const& path, TextureInfo const& info,
                                        Assets assets) {
  if (!info.opacity.empty()) return info.opacity;
  auto now = read("image", decoding::max_texels, path, assets);
  if (now.width != info.width || now.height != info.height) {
    throw Error(fmt::format("{}: changed while it was being read", path.string()));
  }
  return std::move(now.opacity);
}

decoding::Elevations read_elevations(std::filesystem::path const& path) {
  DecodingProcess decoding("gpu_shading_image_decoder", "elevations", path, Assets::restricted);
  decoding::Elevations result;
  auto& header = result.header;
  constexpr auto max_value = std::numeric_limits<std::int32_t>::max();
  header.columns = decoding.next<std::int32_t>(1, max_value);
  header.rows = decoding.next<std::int32_t>(1, max_value);
  header.epsg = decoding.next<std::int32_t>(0, max_value);
  for (auto* const value : {&header.x, &header.y, &header.step_x, &header.step_y}) {
    *value = decoding.next_double();
    if (!std::isfinite(*value)) throw Error("the position of its cells is not finite");
  }
  auto const cells = std::int64_t{header.columns} * header.rows;
  auto const expected = cells > decoding::max_elevations ? 0 : static_cast<std::uint64_t>(cells);
  decoding.next<std::uint64_t>(expected, expected);
  result.elevations = decoding.next_all<double>(expected);
  decoding.finish();
  return result;
}

}  // namespace gpu_shading::energyplus
