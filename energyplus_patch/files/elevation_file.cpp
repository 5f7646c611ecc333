#include "files/elevation_file.h"

#include <cmath>
#include <limits>

#include "files/decoding_process.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

decoding::Elevations read_elevations(std::filesystem::path const& path) {
  DecodingProcess decoding("gpu_shading_image_decoder", "elevations", path, Assets::restricted);
  decoding::Elevations result;
  auto& header = result.header;
  constexpr auto most = std::numeric_limits<std::int32_t>::max();
  header.columns = decoding.next<std::int32_t>(1, most);
  header.rows = decoding.next<std::int32_t>(1, most);
  header.epsg = decoding.next<std::int32_t>(0, most);
  for (auto* const value : {&header.x, &header.y, &header.step_x, &header.step_y}) {
    *value = decoding.next_double();
    if (!std::isfinite(*value)) throw Error("the position of its cells is not finite");
  }
  auto const cells = std::int64_t{header.columns} * header.rows;
  auto const expected = cells > decoding::most_elevations ? 0 : static_cast<std::uint64_t>(cells);
  decoding.next<std::uint64_t>(expected, expected);
  result.elevations = decoding.next_all<double>(expected);
  decoding.finish();
  return result;
}

}  // namespace gpu_shading::energyplus
