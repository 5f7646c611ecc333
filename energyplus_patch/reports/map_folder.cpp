#include "reports/map_folder.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"
#include "reports/map_grid.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::uintmax_t max_list_bytes = std::uintmax_t{1} << 26U;

std::string read_list(std::filesystem::path const& file) {
  if (std::filesystem::file_size(file) > max_list_bytes) {
    throw Error(fmt::format("{}: is larger than 64 MiB", file.string()));
  }
  return read_text_file(file);
}

MapFolder::Row row_of(std::string const& line) {
  // receiver, files, azimuth, tilt, area, cells, their width and height, then the values.
  constexpr std::size_t mean_hours = 8;
  constexpr std::size_t mean_energy = 10;
  constexpr std::size_t columns = 13;
  auto const fields = csv_fields(line);
  auto const number = [&](std::size_t column) {
    return column < fields.size() ? parse_number(fields[column]) : std::nullopt;
  };
  auto const hours = number(mean_hours);
  auto const energy = number(mean_energy);
  if (fields.size() != columns || !hours || !energy) {
    throw Error(fmt::format("expected a row of maps.csv, got {}", in_quotes(line)));
  }
  MapFolder::Row row{fields[0], csv_text(fields[1]), *hours, *energy};
  if (row.stem.empty() || row.stem.find_first_of("/\\") != std::string::npos) {
    throw Error(fmt::format("expected the name of a file, got {}", in_quotes(fields[1])));
  }
  return row;
}

std::string day_of(nlohmann::json const& about, char const* key) {
  static std::regex const form("[01][0-9]-[0-3][0-9]");
  std::string day = about.value(key, "");
  if (!std::regex_match(day, form)) throw Error(fmt::format("{}: expected MM-DD", key));
  return day;
}

struct ArrayShape {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t header = 0;  // bytes before the values
};

ArrayShape shape_of(std::string const& bytes) {
  constexpr std::string_view magic("\x93NUMPY\x01\x00", 8);
  constexpr std::size_t preamble = 10;
  if (!bytes.starts_with(magic) || bytes.size() < preamble) {
    throw Error("is not a NumPy array of version 1.0");
  }
  auto const byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  auto const header = byte(magic.size()) + 256 * byte(magic.size() + 1);
  // As write_array() has it.
  static std::regex const form(
      R"(\{'descr': '<f4', 'fortran_order': False, 'shape': \(2, ([0-9]{1,7}), ([0-9]{1,7})\), \} *\n)");
  std::smatch found;
  auto const text = bytes.substr(preamble, std::min(header, std::size_t{1000}));
  if (!std::regex_match(text, found, form)) throw Error("is not an array of hours and energy");
  return {std::stoul(found[1]), std::stoul(found[2]), preamble + header};
}

std::vector<float> plane_of(std::string const& bytes, std::size_t at, std::size_t count) {
  static_assert(std::endian::native == std::endian::little, "the format's");
  std::vector<float> values(count);
  std::memcpy(values.data(), bytes.data() + at, count * sizeof(float));
  for (float const value : values) {
    if (value < 0.0F || std::isinf(value)) throw Error("has a negative or infinite value");
  }
  return values;
}

MapArray array_of(std::string const& bytes) {
  auto const [rows, columns, header] = shape_of(bytes);
  if (rows == 0 || columns == 0 || rows * columns > MapGrid::max_cells) {
    throw Error(
        fmt::format("has {} x {} cells, expected 1 to {}", rows, columns, MapGrid::max_cells));
  }
  auto const plane = rows * columns;
  if (bytes.size() != header + 2 * plane * sizeof(float)) throw Error("is not as long as it says");
  return {columns, rows, plane_of(bytes, header, plane),
          plane_of(bytes, header + plane * sizeof(float), plane)};
}

}  // namespace

std::optional<MapFolder> read_map_folder(std::filesystem::path const& folder) {
  auto const about = folder / "maps.json";
  auto const list = folder / "maps.csv";
  if (!std::filesystem::is_regular_file(about) || !std::filesystem::is_regular_file(list)) {
    return std::nullopt;
  }
  MapFolder maps;
  naming(about.string(), [&] {
    auto const json = nlohmann::json::parse(read_list(about), nullptr, false);
    if (!json.is_object()) throw Error("is not a JSON object");
    try {
      maps.from = day_of(json, "from");
      maps.to = day_of(json, "to");
    } catch (nlohmann::json::exception const&) {
      throw Error("from and to: expected MM-DD");
    }
  });
  naming(list.string(), [&] {
    std::istringstream lines(read_list(list));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) maps.rows.push_back(row_of(line));
  });
  return maps;
}

MapArray read_map_array(std::filesystem::path const& file) {
  require_file(file);
  constexpr std::uintmax_t max_bytes = 2 * sizeof(float) * MapGrid::max_cells + 70000;
  if (std::filesystem::file_size(file) > max_bytes) {
    throw Error(fmt::format("{}: is larger than a map", file.string()));
  }
  return naming(file.string(), [&] { return array_of(read_text_file(file)); });
}

}  // namespace gpu_shading::energyplus
