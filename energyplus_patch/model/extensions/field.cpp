#include "model/extensions/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::string describe_range(FieldInfo const& field) {
  auto const& low = field.minimum;
  auto const& high = field.maximum;
  if (low && high && low->open) {
    return fmt::format(" above {} and {} {}", low->value, high->open ? "below" : "at most",
                       high->value);
  }
  if (low && high) {
    return high->open ? fmt::format(" of at least {} and below {}", low->value, high->value)
                      : fmt::format(" from {} to {}", low->value, high->value);
  }
  if (low) return fmt::format(" {} {}", low->open ? "above" : "of at least", low->value);
  if (high) return fmt::format(" {} {}", high->open ? "below" : "of at most", high->value);
  return {};
}

std::string describe_number(FieldInfo const& field) {
  auto const range = describe_range(field);
  auto const kind = field.kind == FieldKind::integer ? "an integer" : "a number";
  if (field.units.empty()) return kind + range;
  return fmt::format("{}{}{} {}", kind, range, range.empty() ? " in" : "", field.units);
}

bool is_number(FieldInfo const& field) {
  return field.kind == FieldKind::integer || field.kind == FieldKind::real;
}

bool within(FieldInfo const& field, double value) {
  auto const& low = field.minimum;
  auto const& high = field.maximum;
  return (!low || value > low->value || (!low->open && value == low->value)) &&
         (!high || value < high->value || (!high->open && value == high->value));
}

bool accepts(FieldInfo const& field, std::string const& text) {
  if (field.required && trimmed(text).empty()) return false;
  if (text.empty()) return true;
  if (field.kind == FieldKind::text || field.any_text || word_index(field, text)) return true;
  auto const value = is_number(field) ? parse_number(text) : std::nullopt;
  return value && std::isfinite(*value) && within(field, *value) &&
         (field.kind != FieldKind::integer || std::floor(*value) == *value);
}

// "0,5", which an IDF takes for two fields.
bool is_decimal_comma(std::string const& text) {
  auto const comma = text.find(',');
  if (comma == std::string::npos) return false;
  auto point = text;
  point[comma] = '.';
  return parse_number(point).has_value();
}

// For an error.
std::string hint(FieldInfo const& field, std::string const& text) {
  if (!is_number(field)) return {};
  if (is_decimal_comma(text)) return ": numbers take a decimal point";
  auto const value = parse_number(text);
  if (field.units != "m" || !value || !std::isfinite(*value) || within(field, *value)) return {};
  auto const units = ask_for_units(field, *value, std::numeric_limits<double>::infinity());
  return units.empty() ? "" : ": " + units;
}

}  // namespace

std::string expectation(FieldInfo const& field) {
  std::vector<std::string> parts(field.words.begin(), field.words.end());
  if (is_number(field)) parts.push_back(describe_number(field));
  if (field.any_text) parts.emplace_back("text");
  if (parts.empty()) return "text";
  std::string list = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    list += (i + 1 == parts.size() ? " or " : ", ") + parts[i];
  }
  return list;
}

void check(FieldInfo const& field, std::string const& text, std::string_view title) {
  if (accepts(field, text)) return;
  auto const found = trimmed(text).empty() ? "blank" : in_quotes(text);
  throw Error(
      fmt::format("{} is {}, expected {}{}", title, found, expectation(field), hint(field, text)));
}

std::string ask_for_units(FieldInfo const& field, double value, double max) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  constexpr std::array<Unit, 3> units{
      {{"millimetres", 0.001}, {"centimetres", 0.01}, {"inches", 0.0254}}};
  std::string list;
  for (auto const& [name, metres] : units) {
    double const length = value * metres;
    if (!within(field, length) || length > max) continue;
    list += fmt::format("{}{} ({:.4g})", list.empty() ? "" : ", ", name, length);
  }
  return list.empty() ? "" : "lengths are in metres; is it in " + list + "?";
}

std::optional<std::size_t> word_index(FieldInfo const& field, std::string const& text) {
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    if (same_name(field.words[i], text)) return i;
  }
  return std::nullopt;
}

double detail::checked_number(std::string const& text) { return parse_number(text).value(); }

}  // namespace gpu_shading::energyplus
