#include "platform/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gpu_shading::energyplus {

namespace {

char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

// Whether a byte of UTF-8 belongs to the character before it.
bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80; }

// Adds the byte text[i], escaped if it is part of a control character.
void add_escaped(std::string_view text, std::size_t i, std::string& line) {
  auto const byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  bool const is_c1 = (i > 0 && byte(i - 1) == 0xc2 && byte(i) < 0xa0) ||
                     (byte(i) == 0xc2 && i + 1 < text.size() && byte(i + 1) < 0xa0);
  if (text[i] == '\n') {
    line += "\\n";
  } else if (is_control(byte(i)) || is_c1) {
    line += fmt::format("\\x{:02x}", static_cast<unsigned>(byte(i)));
  } else {
    line += text[i];
  }
}

}  // namespace

std::string upper(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return upper(c); });
  return result;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return upper(x) == upper(y); });
}

bool matches(std::string_view pattern, std::string_view name) {
  constexpr auto none = std::string_view::npos;
  std::size_t at = 0;       // in the pattern
  std::size_t star = none;  // the last star before it,
  std::size_t taken = 0;    // and the end of what that star stands for
  for (std::size_t i = 0; i < name.size();) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      taken = i;
    } else if (at < pattern.size() && upper(pattern[at]) == upper(name[i])) {
      ++at;
      ++i;
    } else if (star != none) {
      // Earlier stars need not be tried again: what follows them was found at the first place.
      at = star + 1;
      i = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == none;
}

std::optional<double> parse_number(std::string const& text) {
  // from_chars does not accept a plus sign.
  bool const plus = text.starts_with('+') && !text.starts_with("+-");
  char const* const begin = text.data() + (plus ? 1 : 0);
  char const* const end = text.data() + text.size();
  double value = 0.0;
  auto const [parsed, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || parsed != end || !std::isfinite(value)) return std::nullopt;
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
  constexpr std::size_t max_length = 80;
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    // Not within a character of UTF-8.
    if (line.size() >= max_length && !continues(text[i])) return line + "...";
    add_escaped(text, i, line);
  }
  return line;
}

std::string one_line(std::string_view message) {
  constexpr std::size_t max_length = 2000;
  constexpr std::size_t start = 1200;
  std::string line;
  for (std::size_t i = 0; i < message.size(); ++i) {
    if (message[i] == '\n') {
      // Lists, of which each item has a line, are indented.
      auto const next = std::min(message.find_first_not_of(" \t\r\n", i), message.size());
      if (!line.empty() && line.back() != ' ' && next < message.size()) line += ' ';
      i = next - 1;
    } else {
      add_escaped(message, i, line);
    }
  }
  if (line.size() <= max_length) return line;
  auto from = start;
  auto to = line.size() - (max_length - start);
  while (from > 0 && continues(line[from])) --from;
  while (to < line.size() && continues(line[to])) ++to;
  return line.substr(0, from) + " ... " + line.substr(to);
}

std::string without_controls(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') {
      escaped += '\n';
    } else {
      add_escaped(text, i, escaped);
    }
  }
  return escaped;
}

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", printable(text)); }

std::string csv_quoted(std::string_view text) {
  constexpr std::string_view formula = "=+-@\t\r";
  bool const is_formula = !text.empty() && formula.find(text.front()) != std::string_view::npos;
  std::string field = "\"";
  if (is_formula && !parse_number(std::string(text))) field += '\'';
  for (char const letter : text) {
    if (letter == '"') field += '"';
    field += letter;
  }
  return field + '"';
}

std::string csv_field(std::string_view text) {
  auto quoted = csv_quoted(text);
  bool const same = quoted.size() == text.size() + 2;
  return same && text.find_first_of(",\"\r\n") == std::string_view::npos ? std::string(text)
                                                                         : quoted;
}

std::vector<std::string> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (char const character : line) {
    if (character == '"') quoted = !quoted;
    if (character == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += character;
    }
  }
  return fields;
}

std::string csv_text(std::string const& field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return field;
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;  // doubled
  }
  return text;
}

namespace {

// The distance of Damerau and Levenshtein in its restricted form (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view text, std::vector<std::string> const& words) {
  std::string_view nearest;
  std::size_t least = text.size() + 1;
  auto const typed = upper(text);
  for (auto const& word : words) {
    // Names in models and flags have no case.
    auto const known = upper(word);
    auto const rest = std::ranges::mismatch(typed, known).in1;
    auto const same = static_cast<std::size_t>(rest - typed.begin());
    // Of the letters from the first wrong one on, a third may be wrong.
    auto const allowed = std::max<std::size_t>(1, (text.size() - same + 2) / 3);
    auto const steps =
        distance(std::string_view(typed).substr(same), std::string_view(known).substr(same));
    if (steps <= allowed && steps < least) {
      least = steps;
      nearest = word;
    }
  }
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::string valid_utf8(std::string const& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

std::string markup_text(std::string const& text) {
  constexpr unsigned char first_printable = 0x20;
  std::string escaped;
  for (char const character : valid_utf8(text)) {
    switch (character) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(character) < first_printable ? '?' : character;
    }
  }
  return escaped;
}

bool matches_any(std::vector<std::string> const& patterns, std::string_view name) {
  return std::ranges::any_of(patterns,
                             [&](std::string const& pattern) { return matches(pattern, name); });
}

std::string listed(std::vector<std::string> const& names, std::size_t max) {
  std::string text;
  for (std::size_t i = 0; i < std::min(max, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + printable(names[i]);
  }
  return names.size() > max ? fmt::format("{} and {} more", text, names.size() - max) : text;
}

}  // namespace gpu_shading::energyplus
