#include "input/text.h"

#include <sstream>

namespace gpu_shading::energyplus {

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::vector<std::string> comma_separated(std::string const& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(trimmed(field));
  return fields;
}

std::string csv_quoted(std::string_view text) {
  std::string field = "\"";
  for (char const letter : text) {
    if (letter == '"') field += '"';
    field += letter;
  }
  return field + '"';
}

}  // namespace gpu_shading::energyplus
