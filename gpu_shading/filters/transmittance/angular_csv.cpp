#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

struct Line {
  std::size_t number = 0;
  std::vector<std::string> fields;  // in lower case, without blanks and quotes around them
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view around = " \t\r\"";
  std::size_t const first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(around) - first + 1);
}

// Blanks only separate if nothing else does: "Angle (deg), Tsol". WINDOW puts a colon after the
// name of a row.
std::vector<std::string> split(std::string_view text) {
  bool const separated = text.find_first_of(",;\t") != std::string_view::npos;
  std::string_view const separators = separated ? ",;\t" : " :\r";
  std::vector<std::string> fields;
  std::size_t from = 0;
  while (from <= text.size()) {
    std::size_t const to = std::min(text.find_first_of(separators, from), text.size());
    std::string field(trimmed(text.substr(from, to - from)));
    std::transform(field.begin(), field.end(), field.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (separated || !field.empty()) fields.push_back(std::move(field));
    from = to + 1;
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::vector<Line> read_lines(std::filesystem::path const& path) {
  // Not a pipe or a device, which may never come to an end.
  constexpr std::uintmax_t max_bytes = std::uintmax_t{64} << 20U;
  std::error_code failure;
  if (std::filesystem::exists(path, failure) && !std::filesystem::is_regular_file(path, failure)) {
    throw Error(fmt::format("{}: is not a file", path.string()));
  }
  std::ifstream file(path);
  if (file && std::filesystem::file_size(path, failure) > max_bytes) {
    throw Error(fmt::format("{}: is larger than 64 MiB", path.string()));
  }
  if (!file) throw Error(fmt::format("{}: cannot be read", path.string()));
  std::vector<Line> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (number == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    Line line{number, split(text)};
    if (!line.fields.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> number(std::string const& field) {
  double value = 0.0;
  auto const [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    return {};
  return value;
}

bool is_angle(std::string_view field) {
  return field.starts_with("angle") || field.starts_with("theta") || field.starts_with("incidence");
}

bool is_transmittance(std::string_view field) {
  return field.starts_with("tsol") || field.starts_with("transmittance") || field == "tau" ||
         field.starts_with("solar transmittance");
}

using Lines = std::vector<Line>::const_iterator;

// Reads one file; all errors name the file and, if possible, the line.
class AngularFile {
 public:
  explicit AngularFile(std::filesystem::path const& path) : path_(path), lines_(read_lines(path)) {}

  Transmittance read() {
    for (auto line = lines_.cbegin(); line != lines_.cend(); ++line) {
      if (is_row_of_angles(*line)) return read_rows(line);
    }
    for (auto line = lines_.cbegin(); line != lines_.cend(); ++line) {
      auto const& fields = line->fields;
      auto const angle = std::find_if(fields.begin(), fields.end(), is_angle);
      auto const value = std::find_if(fields.begin(), fields.end(), is_transmittance);
      if (angle != fields.end() && value != fields.end()) {
        return read_columns(line + 1, angle - fields.begin(), value - fields.begin(),
                            fields.size());
      }
    }
    bool const headed = !lines_.empty() && !number(lines_.front().fields.front());
    return read_columns(lines_.cbegin() + (headed ? 1 : 0), 0, 1, 2);
  }

 private:
  [[noreturn]] void fail(std::size_t line, std::string_view message) const {
    throw Error(fmt::format("{}:{}: {}", path_.string(), line, message));
  }

  double value(Line const& line, std::size_t column) const {
    if (auto const found = number(line.fields[column])) return *found;
    fail(line.number, fmt::format("\"{}\" is not a number", line.fields[column]));
  }

  // The values of each line are checked immediately, so that the error can name the line.
  void add(Line const& line, double angle, double transmittance) {
    if (!(angle >= 0.0 && angle <= 90.0)) {
      fail(line.number, fmt::format("angle is {:.9g} degrees, expected 0 to 90", angle));
    }
    if (!angles_.empty() && angle <= angles_.back()) {
      fail(line.number, fmt::format("angle of {:.9g} degrees follows {:.9g}, expected increasing "
                                    "angles",
                                    angle, angles_.back()));
    }
    if (!(transmittance >= 0.0 && transmittance <= 1.0)) {
      fail(line.number, fmt::format("transmittance is {:.9g} at {:.4g} degrees, expected 0 to 1",
                                    transmittance, angle));
    }
    angles_.push_back(angle);
    values_.push_back(transmittance);
  }

  Transmittance made() {
    if (angles_.size() < 2) {
      throw Error(fmt::format("{}: {} lines of angle and transmittance, expected 2 or more",
                              path_.string(), angles_.size()));
    }
    return Transmittance::table(std::move(angles_), std::move(values_));
  }

  Transmittance read_columns(Lines line, std::ptrdiff_t angle, std::ptrdiff_t transmittance,
                             std::size_t columns) {
    for (; line != lines_.cend(); ++line) {
      if (line->fields.size() != columns) {
        fail(line->number, fmt::format("{} columns, expected {}", line->fields.size(), columns));
      }
      add(*line, value(*line, static_cast<std::size_t>(angle)),
          value(*line, static_cast<std::size_t>(transmittance)));
    }
    return made();
  }

  static bool is_row_of_angles(Line const& line) {
    return line.fields.size() > 2 && is_angle(line.fields[0]) && number(line.fields[1]) &&
           number(line.fields[2]);
  }

  Transmittance read_rows(Lines angles) {
    auto const row = std::find_if(angles + 1, lines_.cend(), [](Line const& line) {
      return is_transmittance(line.fields.front());
    });
    if (row == lines_.cend()) {
      fail(angles->number, "no line \"Tsol\" below the line of angles");
    }
    if (row->fields.size() != angles->fields.size()) {
      fail(row->number, fmt::format("{} columns, expected {} as in line {}", row->fields.size(),
                                    angles->fields.size(), angles->number));
    }
    for (std::size_t column = 1; column < row->fields.size(); ++column) {
      if (angles->fields[column].starts_with("hemis")) continue;
      add(*row, value(*angles, column), value(*row, column));
    }
    return made();
  }

  std::filesystem::path path_;
  std::vector<Line> lines_;
  std::vector<double> angles_;
  std::vector<double> values_;
};

}  // namespace

Transmittance read_angular_csv(std::filesystem::path const& path) {
  return AngularFile(path).read();
}

}  // namespace gpu_shading
