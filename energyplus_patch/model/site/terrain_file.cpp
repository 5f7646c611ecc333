#include "model/site/terrain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Returns the words of a text one by one.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  // "" at the end.
  std::string_view next() {
    auto const begin = rest_.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return rest_ = {};
    rest_.remove_prefix(begin);
    auto const word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::string_view peek() const {
    auto ahead = *this;
    return ahead.next();
  }

 private:
  static constexpr std::string_view blanks = " \t\r\n";

  std::string_view rest_;
};

// Grids may have nan where they have no data.
bool is_nan(std::string_view word) { return same_name(word, "nan") || same_name(word, "-nan"); }

bool is_number(std::string_view word) {
  return is_nan(word) || parse_number(std::string(word)).has_value();
}

class Header {
  // Far beyond any coordinate and any usual value of NODATA.
  static constexpr double max_value = 1e39;

 public:
  // Reads pairs of key and value up to the first elevation.
  explicit Header(Words& words) {
    while (!words.peek().empty() && !is_number(words.peek())) {
      auto const key = upper(words.next());
      auto const text = std::string(words.next());
      bool const no_data = key == "NODATA_VALUE" && is_nan(text);
      auto const value = no_data ? std::numeric_limits<double>::quiet_NaN() : parse_number(text);
      if (!value || std::abs(*value) > max_value) {
        throw Error(fmt::format("{} is {}, expected a number", printable(key), in_quotes(text)));
      }
      values_[key] = *value;
    }
  }

  std::optional<double> get(std::string const& key) const {
    auto const found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }

  double need(std::string const& key) const {
    auto const value = get(key);
    if (!value) {
      throw Error(fmt::format("is not an ESRI ASCII grid: {} is missing", key));
    }
    return *value;
  }

  int count(std::string const& key) const {
    double const value = need(key);
    if (!(value >= 2.0 && value <= max_terrain_nodes) || value != std::floor(value)) {
      throw Error(
          fmt::format("{} is {}, expected an integer from 2 to {}", key, value, max_terrain_nodes));
    }
    return static_cast<int>(value);
  }

  double step(std::string const& key) const {
    auto const own = get(key);
    double const value = own ? *own : need("CELLSIZE");
    if (!(value > 0.0)) {
      throw Error(fmt::format("{} is {}, expected more than 0", own ? key : "CELLSIZE", value));
    }
    return value;
  }

  // Position of the centre of the south-west cell.
  double first(std::string const& axis, double size) const {
    if (auto const centre = get(axis + "LLCENTER")) return *centre;
    return need(axis + "LLCORNER") + 0.5 * size;
  }

 private:
  std::map<std::string, double> values_;
};

void read_elevations(Words& words, double no_data, TerrainGrid& grid) {
  grid.elevations.assign(
      static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns), 0.0);
  for (int row = 0; row < grid.rows; ++row) {
    auto* const to = grid.elevations.data() + static_cast<std::size_t>(grid.rows - 1 - row) *
                                                  static_cast<std::size_t>(grid.columns);
    for (int column = 0; column < grid.columns; ++column) {
      auto word = words.next();
      // from_chars does not accept a plus sign.
      if (word.starts_with('+')) word.remove_prefix(1);
      double value = 0.0;
      auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (word.empty()) {
        throw Error(fmt::format("ends in row {} of {}, column {} of {}", row + 1, grid.rows,
                                column + 1, grid.columns));
      }
      bool const missing = value == no_data || (std::isnan(value) && std::isnan(no_data));
      if (error != std::errc{} || end != word.data() + word.size() ||
          (!missing && !std::isfinite(value))) {
        throw Error(fmt::format("row {}, column {} is {}, expected a number{}", row + 1, column + 1,
                                in_quotes(word),
                                std::isnan(value) ? " (NODATA_value is not nan)" : ""));
      }
      to[column] = missing ? std::numeric_limits<double>::quiet_NaN() : value;
    }
  }
  if (!words.next().empty()) {
    throw Error(fmt::format("has more than {} x {} elevations", grid.columns, grid.rows));
  }
}

TerrainGrid read_grid(std::string_view text, MapCoordinates const& coordinates) {
  Words words(text);
  Header const header(words);
  TerrainGrid grid;
  grid.coordinates = coordinates;
  grid.columns = header.count("NCOLS");
  grid.rows = header.count("NROWS");
  check_terrain_size(grid.columns, grid.rows);
  grid.step_x = header.step("DX");
  grid.step_y = header.step("DY");
  grid.first = {header.first("X", grid.step_x), header.first("Y", grid.step_y)};
  constexpr double usual = -9999.0;
  read_elevations(words, header.get("NODATA_VALUE").value_or(usual), grid);
  return grid;
}

// Cells that round to the same position, or go round the earth, would collapse silently.
void check_cells(TerrainGrid const& grid) {
  bool const degrees = grid.coordinates.geographic();
  char const* const unit = degrees ? "degrees" : "m";
  double const min_step = degrees ? 1e-8 : 1e-3;  // a millimetre
  // Negated so that NaN is refused.
  if (!(grid.step_x >= min_step && grid.step_y >= min_step)) {
    throw Error(fmt::format("its cells are {} x {} {}, expected at least {} each way", grid.step_x,
                            grid.step_y, unit, min_step));
  }
  constexpr double turn = 360.0;
  double const across = grid.step_x * (grid.columns - 1);
  if (degrees && across > turn) {
    throw Error(fmt::format("its rows are {} degrees long, expected at most 360", across));
  }
}

// Other elevations mean a damaged file, another unit, or NODATA that is not declared.
void check_range(TerrainGrid const& grid) {
  constexpr double min_elevation = -500.0;
  constexpr double max_elevation = 9000.0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      double const value = grid.elevation(column, row);
      if (std::isnan(value) || (value >= min_elevation && value <= max_elevation)) continue;
      throw Error(fmt::format(
          "the elevation in row {} from the south, column {} is {} m, expected {} to {} or NODATA",
          row + 1, column + 1, value, min_elevation, max_elevation));
    }
  }
}

}  // namespace

void check_terrain_size(int columns, int rows) {
  if (columns < 2 || rows < 2) {
    throw Error(fmt::format("is {} x {} cells, expected at least 2 x 2", columns, rows));
  }
  if (columns <= max_terrain_nodes / rows) return;
  throw Error(
      fmt::format("is {} x {} cells, expected at most {} (reduce it with gdal_translate -outsize)",
                  columns, rows, max_terrain_nodes));
}

TerrainGrid read_terrain(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates) {
  auto const tiff = is_tiff(path);
  auto const text = tiff ? std::string() : read_text_file(path);
  return naming(path.string(), [&] {
    auto grid = tiff ? read_geotiff(path, coordinates)
                     : read_grid(text, coordinates.value_or(MapCoordinates()));
    if (std::ranges::all_of(grid.elevations, [](double value) { return std::isnan(value); })) {
      throw Error("has no elevations: all cells are NODATA");
    }
    check_cells(grid);
    check_range(grid);
    return grid;
  });
}

}  // namespace gpu_shading::energyplus
