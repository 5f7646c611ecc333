#include "site/terrain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "files/text_file.h"
#include "gpu_shading/error.h"
#include "input/input_object.h"
#include "input/naming.h"
#include "input/number.h"
#include "site/geotiff.h"

namespace gpu_shading::energyplus {
namespace {

// The words of a text, in turn.
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

bool is_number(std::string_view word) { return parse_number(std::string(word)).has_value(); }

class Header {
 public:
  // Takes key and value pairs, up to the first elevation.
  explicit Header(Words& words) {
    while (!words.peek().empty() && !is_number(words.peek())) {
      auto const key = upper(words.next());
      auto const text = std::string(words.next());
      auto const value = parse_number(text);
      // A grid may say nan for what it lacks.
      if (!value) throw Error(fmt::format("{} is \"{}\", not a number", key, text));
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
      throw Error(fmt::format("{} is {}, expected a whole number from 2 to {}", key, value,
                              max_terrain_nodes));
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

  // Of the south-western cell's centre.
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
      // from_chars knows no plus sign.
      if (word.starts_with('+')) word.remove_prefix(1);
      double value = 0.0;
      auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (word.empty()) {
        throw Error(fmt::format("ends in row {} of {}, column {} of {}", row + 1, grid.rows,
                                column + 1, grid.columns));
      }
      if (error != std::errc{} || end != word.data() + word.size()) {
        throw Error(
            fmt::format("row {}, column {} is \"{}\", not a number", row + 1, column + 1, word));
      }
      bool const missing = value == no_data || !std::isfinite(value);
      to[column] = missing ? std::numeric_limits<double>::quiet_NaN() : value;
    }
  }
  if (!words.next().empty()) {
    throw Error(fmt::format("holds more than {} x {} elevations", grid.columns, grid.rows));
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

}  // namespace

void check_terrain_size(int columns, int rows) {
  if (columns < 2 || rows < 2) {
    throw Error(fmt::format("is {} x {} cells, expected at least 2 x 2", columns, rows));
  }
  if (columns <= max_terrain_nodes / rows) return;
  throw Error(
      fmt::format("is {} x {} cells, expected at most {} (gdal_translate -outsize makes fewer)",
                  columns, rows, max_terrain_nodes));
}

TerrainGrid read_terrain(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates) {
  auto const tiff = is_tiff(path);
  auto const text = tiff ? std::string() : read_text_file(path);
  return naming(path.string(), [&] {
    auto grid = tiff ? read_geotiff(path, coordinates)
                     : read_grid(text, coordinates.value_or(MapCoordinates()));
    if (std::none_of(grid.elevations.begin(), grid.elevations.end(),
                     [](double value) { return std::isfinite(value); })) {
      throw Error("holds no elevation: all of it is NODATA");
    }
    return grid;
  });
}

}  // namespace gpu_shading::energyplus
