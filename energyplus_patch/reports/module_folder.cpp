#include "reports/module_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

constexpr std::size_t max_fields = 1000;
constexpr std::size_t max_modules = 10'000;
constexpr std::size_t max_strings = 20;
constexpr int max_days = 366;

std::string read_table(Path const& file) {
  constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 26U;
  if (std::filesystem::file_size(file) > max_bytes) throw Error("is larger than 64 MiB");
  return read_text_file(file);
}

// The rows of a table, with access to their fields by column.
class TableRow {
 public:
  TableRow(std::string const& line, std::map<std::string, std::size_t> const& columns)
      : columns_(columns), fields_(csv_fields(line)) {
    if (fields_.size() != columns.size()) {
      throw Error(fmt::format("expected {} columns, got {}", columns.size(), in_quotes(line)));
    }
  }

  std::string const& text(char const* column) const { return fields_.at(index(column)); }
  double number(char const* column) const {
    auto const value = parse_number(text(column));
    if (!value) throw Error(fmt::format("{} is {}", column, in_quotes(text(column))));
    return *value;
  }
  int whole(char const* column, int max) const {
    double const value = number(column);
    if (value >= 1.0 && value <= max && std::floor(value) == value) return static_cast<int>(value);
    throw Error(fmt::format("{} is {}, expected 1 to {}", column, value, max));
  }

 private:
  std::size_t index(char const* column) const {
    auto const found = columns_.find(column);
    if (found == columns_.end()) throw Error(fmt::format("has no column {}", column));
    return found->second;
  }

  std::map<std::string, std::size_t> const& columns_;
  std::vector<std::string> fields_;
};

void for_each_row(Path const& file, std::function<void(TableRow const&)> const& use) {
  naming(file.string(), [&] {
    std::istringstream lines(read_table(file));
    std::string line;
    std::getline(lines, line);
    std::map<std::string, std::size_t> columns;
    for (auto const& column : csv_fields(line)) columns.emplace(column, columns.size());
    while (std::getline(lines, line)) use(TableRow(line, columns));
  });
}

double side_of(Json const& field, char const* key) {
  constexpr double longest = 10'000.0;
  double const value = field.at(key).get<double>();
  if (value > 0.0 && value <= longest) return value;
  throw Error(fmt::format("{} is {}, expected above 0", key, value));
}

PageModules::Field module_field(Json const& json) {
  PageModules::Field field;
  field.surface = json.at("surface").get<std::string>();
  field.width = side_of(json, "module_width");
  field.height = side_of(json, "module_area") / field.width;
  if (json.at("landscape").get<bool>()) std::swap(field.width, field.height);
  return field;
}

std::vector<PageModules::Field> read_module_fields_of(Path const& file) {
  return naming(file.string(), [&] {
    auto const json = Json::parse(read_table(file), nullptr, false);
    std::vector<PageModules::Field> fields;
    try {
      if (json.at("format") != "gpu_shading modules 1") throw Error("is of another format");
      for (auto const& field : json.at("fields")) {
        fields.push_back(module_field(field));
        if (fields.size() > max_fields) throw Error(fmt::format("more than {} fields", max_fields));
      }
    } catch (Json::exception const&) {
      throw Error("expected the fields of gpu_shading modules");
    }
    return fields;
  });
}

class ModuleReading {
 public:
  explicit ModuleReading(Path const& folder) {
    read_.fields = read_module_fields_of(folder / "modules.json");
    for (std::size_t i = 0; i < read_.fields.size(); ++i) {
      numbers_.emplace(csv_field(read_.fields[i].surface), i);
    }
    for_each_row(folder / "modules.csv", [&](TableRow const& row) { add_module(row); });
    for_each_row(folder / "times.csv", [&](TableRow const& row) { add_day(row); });
    make_room();
    for_each_row(folder / "strings.csv", [&](TableRow const& row) { add_hour(row); });
    end_hour();
  }

  PageModules take() { return std::move(read_); }

 private:
  PageModules::Field& field_in(TableRow const& row) {
    auto const found = numbers_.find(valid_utf8(row.text("surface")));
    if (found != numbers_.end()) return read_.fields[found->second];
    throw Error(fmt::format("{} is not in modules.json", in_quotes(row.text("surface"))));
  }

  void add_module(TableRow const& row) {
    constexpr int most = 100'000;
    PageModules::Module module{row.whole("string", most), row.whole("column", most),
                               row.whole("row", most), row.number("beam loss")};
    module.loss = std::clamp(module.loss, 0.0, 1.0);
    field_in(row).modules.push_back(module);
    if (++modules_ > max_modules) throw Error(fmt::format("more than {} modules", max_modules));
  }

  static std::pair<int, int> day_of(TableRow const& row) {
    constexpr int months = 12;
    constexpr int days = 31;
    return {row.whole("month", months), row.whole("day", days)};
  }

  void add_day(TableRow const& row) {
    if (days_.try_emplace(day_of(row), read_.days.size()).second) read_.days.push_back(day_of(row));
    if (read_.days.size() > max_days) throw Error("more days than a year has");
  }

  void make_room() {
    std::size_t room = max_strings;
    for (auto& field : read_.fields) {
      std::size_t strings = 0;
      for (auto const& module : field.modules) {
        strings = std::max(strings, static_cast<std::size_t>(module.string));
      }
      auto const shown = std::min(strings, room);
      std::vector<std::uint8_t> const empty(read_.days.size() * PageModules::hours_of_day,
                                            PageModules::dark);
      field.strings.assign(shown, empty);
      room -= shown;
      read_.left_out += strings - shown;
    }
  }

  // The timesteps of an hour follow each other.
  void add_hour(TableRow const& row) {
    auto& field = field_in(row);
    constexpr int most = 100'000;
    auto const string = static_cast<std::size_t>(row.whole("string", most)) - 1;
    auto const day = days_.find(day_of(row));
    if (day == days_.end()) throw Error("has a day that times.csv lacks");
    if (string >= field.strings.size()) return;
    auto const hour =
        static_cast<std::size_t>(row.whole("hour", int{PageModules::hours_of_day})) - 1;
    auto* const code = &field.strings[string][day->second * PageModules::hours_of_day + hour];
    if (code != code_) end_hour();
    code_ = code;
    sum_ += std::clamp(row.number("sunlit fraction"), 0.0, 1.0);
    ++steps_;
  }

  void end_hour() {
    constexpr double percent = 100.0;
    if (code_ != nullptr) *code_ = static_cast<std::uint8_t>(std::lround(percent * sum_ / steps_));
    sum_ = 0.0;
    steps_ = 0;
  }

  PageModules read_;
  std::map<std::string, std::size_t> numbers_;  // of fields, by surface as written in CSV
  std::map<std::pair<int, int>, std::size_t> days_;
  std::size_t modules_ = 0;
  // The hour that is being summed.
  std::uint8_t* code_ = nullptr;
  double sum_ = 0.0;
  int steps_ = 0;
};

}  // namespace

std::optional<PageModules> read_module_folder(Path const& folder) {
  if (!std::filesystem::is_regular_file(folder / "modules.json")) return std::nullopt;
  return ModuleReading(folder).take();
}

}  // namespace gpu_shading::energyplus
