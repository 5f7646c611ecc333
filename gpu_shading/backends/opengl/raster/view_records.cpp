#include "backends/opengl/raster/view_records.h"

#include <array>
#include <cstddef>

#include "backends/opengl/raster/draw_list.h"

namespace gpu_shading {

void add_view_records(gl::VertexArray& array, gl::Buffer const& views) {
  constexpr std::array rows{offsetof(ViewRecord, x),           offsetof(ViewRecord, y),
                            offsetof(ViewRecord, z),           offsetof(ViewRecord, cut),
                            offsetof(ViewRecord, origin_high), offsetof(ViewRecord, origin_low)};
  // As in slide.vert.
  constexpr std::uint32_t first_row = 4;
  constexpr std::uint32_t numbers = 10;
  using Of = gl::VertexArray::Of;
  array.set_records(views, sizeof(ViewRecord));
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    array.add_floats(Of::records, first_row + row, 4, rows.at(row));
  }
  array.add_integers(Of::records, numbers, 4, offsetof(ViewRecord, numbers));
}

}  // namespace gpu_shading
