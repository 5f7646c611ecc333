#include "tasks/samples/year_table.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <regex>

#include "gpu_shading/error.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

double number_in(std::string const& field, double low, double high) {
  auto const value = parse_number(field);
  if (value && *value >= low && *value <= high) return *value;
  throw Error(fmt::format("{}, expected {:g} to {:g}", in_quotes(field), low, high));
}

}  // namespace

SampledHours read_hours_of_21st(std::istream& csv) {
  static std::regex const full_hour(R"([0-9]{4}-(0[1-9]|1[0-2])-21 ([01][0-9]|2[0-3]):00,.*)");
  SampledHours read;
  std::string line;
  std::getline(csv, line);
  constexpr std::string_view first_columns = "time,azimuth,altitude,";
  if (!line.starts_with(first_columns)) {
    throw Error(fmt::format("line 1: expected columns {}...", first_columns));
  }
  read.receivers = csv_fields(std::string_view(line).substr(first_columns.size()));
  for (int number = 2; std::getline(csv, line); ++number) {
    constexpr std::size_t time = 17;  // characters, with its comma
    std::smatch found;
    auto const begin = line.substr(0, time);
    if (!std::regex_match(begin, found, full_hour)) continue;
    naming(fmt::format("line {}", number), [&] {
      auto const fields = csv_fields(line);
      constexpr std::size_t first = 3;
      if (fields.size() != first + read.receivers.size()) {
        throw Error(
            fmt::format("{} values, expected {}", fields.size(), first + read.receivers.size()));
      }
      auto& hour = read.hours.emplace_back();
      hour.month = std::stoi(found[1]);
      hour.hour = std::stoi(found[2]);
      hour.sun = {glm::radians(number_in(fields[1], 0.0, 360.0)),
                  glm::radians(number_in(fields[2], -90.0, 90.0))};
      for (std::size_t i = first; i < fields.size(); ++i) {
        hour.fractions.push_back(number_in(fields[i], 0.0, 1.0));
      }
    });
  }
  return read;
}

}  // namespace gpu_shading::energyplus
