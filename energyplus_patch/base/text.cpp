#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

namespace gpu_shading::energyplus {
namespace {

char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

}  // namespace

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](char c) { return upper(c); });
  return result;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return upper(x) == upper(y); });
}

bool matches(std::string_view pattern, std::string_view name) {
  auto const star = pattern.find('*');
  if (star == std::string_view::npos) return same_name(pattern, name);
  if (name.size() < star || !same_name(pattern.substr(0, star), name.substr(0, star))) return false;
  auto const rest = pattern.substr(star + 1);
  for (std::size_t at = star; at <= name.size(); ++at) {
    if (matches(rest, name.substr(at))) return true;
  }
  return false;
}

std::optional<double> parse_number(std::string const& text) {
  // from_chars does not accept a plus sign.
  bool const plus = text.starts_with('+') && !text.starts_with("+-");
  char const* const begin = text.data() + (plus ? 1 : 0);
  char const* const end = text.data() + text.size();
  double value = 0.0;
  auto const [parsed, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || parsed != end) return std::nullopt;
  return value;
}

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

std::string printable(std::string_view text) {
  constexpr std::size_t most = 80;
  std::string line;
  for (char const letter : text) {
    // Not within a character of UTF-8.
    bool const continues = (static_cast<unsigned char>(letter) & 0xc0U) == 0x80;
    if (line.size() >= most && !continues) return line + "...";
    bool const is_control = static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
    if (letter == '\n') {
      line += "\\n";
    } else if (is_control) {
      line += fmt::format("\\x{:02x}", static_cast<unsigned>(letter));
    } else {
      line += letter;
    }
  }
  return line;
}

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", printable(text)); }

std::string csv_quoted(std::string_view text) {
  std::string field = "\"";
  for (char const letter : text) {
    if (letter == '"') field += '"';
    field += letter;
  }
  return field + '"';
}

}  // namespace gpu_shading::energyplus
