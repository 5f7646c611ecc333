#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <ostream>

#include "platform/text.h"
#include "programs/gpu_shading/map_files.h"

namespace gpu_shading::energyplus {

MapSummary summarise(MapGrid const& grid, std::vector<MapValue> const& values) {
  auto const& normal = grid.axes().normal;
  constexpr double circle = 360.0;
  constexpr double vertical = 1e-6;  // sine of the tilt
  MapSummary summary;
  if (std::hypot(normal.x, normal.y) > vertical) {
    summary.azimuth = std::fmod(glm::degrees(std::atan2(normal.x, normal.y)) + circle, circle);
  }
  summary.tilt = glm::degrees(std::acos(std::clamp(normal.z, -1.0, 1.0)));
  summary.cell_width = grid.cell_size().x;
  summary.cell_height = grid.cell_size().y;
  summary.cells = grid.cells().size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const area = grid.cells()[i].area;
    summary.area += area;
    summary.mean.hours += area * values[i].hours;
    summary.mean.energy += area * values[i].energy;
    summary.largest.hours = std::max(summary.largest.hours, values[i].hours);
    summary.largest.energy = std::max(summary.largest.energy, values[i].energy);
  }
  summary.mean.hours /= summary.area;
  summary.mean.energy /= summary.area;
  return summary;
}

void write_cells(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& csv) {
  csv << "column,row,x [m],y [m],z [m],u [m],v [m],area [m2],sunlit [h],beam [kWh/m2]\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto const& cell = grid.cells()[i];
    auto const place = grid.axes().place(cell.centre);
    csv << fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.8g},{:.6g},{:.6g}\n",
                       cell.column, cell.row, place.x, place.y, place.z, cell.centre.x,
                       cell.centre.y, cell.area, values[i].hours, values[i].energy);
  }
}

void write_npy_header(std::string_view type, std::vector<std::size_t> const& shape,
                      std::ostream& npy) {
  auto header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                            fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::size_t preamble = 10;
  constexpr std::size_t aligned = 64;
  while ((preamble + header.size() + 1) % aligned != 0) header += ' ';
  header += '\n';
  npy << "\x93NUMPY" << '\x01' << '\x00' << static_cast<char>(header.size() % 256)
      << static_cast<char>(header.size() / 256) << header;
}

void write_array(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& npy) {
  static_assert(std::endian::native == std::endian::little, "the format named below");
  write_npy_header(
      "<f4", {2, static_cast<std::size_t>(grid.rows()), static_cast<std::size_t>(grid.columns())},
      npy);
  auto const plane =
      static_cast<std::size_t>(grid.rows()) * static_cast<std::size_t>(grid.columns());
  std::vector<float> all(2 * plane, std::nanf(""));
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto const& cell = grid.cells()[i];
    auto const at = static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(grid.columns()) +
                    static_cast<std::size_t>(cell.column);
    all[at] = static_cast<float>(values[i].hours);
    all[plane + at] = static_cast<float>(values[i].energy);
  }
  npy.write(reinterpret_cast<char const*>(all.data()),
            static_cast<std::streamsize>(all.size() * sizeof(float)));
}

void write_summaries(std::vector<MapSummary> const& summaries, std::ostream& csv) {
  csv << "receiver,files,azimuth [deg],tilt [deg],area [m2],cells,cell width [m],cell height [m],"
         "sunlit mean [h],sunlit most [h],beam mean [kWh/m2],beam most [kWh/m2],beam sum [kWh]\n";
  for (auto const& one : summaries) {
    csv << fmt::format(
        "{},{},{:.2f},{:.2f},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},"
        "{:.7g}\n",
        csv_field(one.receiver), csv_field(one.stem), one.azimuth, one.tilt, one.area, one.cells,
        one.cell_width, one.cell_height, one.mean.hours, one.largest.hours, one.mean.energy,
        one.largest.energy, one.mean.energy * one.area);
  }
}

}  // namespace gpu_shading::energyplus
