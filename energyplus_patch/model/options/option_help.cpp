#include <fmt/format.h>

#include <sstream>

#include "model/extensions/field.h"
#include "model/options/option_table.h"

namespace gpu_shading::energyplus {
namespace {

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

bool is_number(FieldInfo const& value) {
  return value.kind == FieldKind::integer || value.kind == FieldKind::real;
}

// In Markdown.
std::string meaning_of(OptionRow const& row) {
  if (!is_number(row.value)) return std::string(row.meaning);
  FieldInfo number = row.value;
  number.words = {};
  return fmt::format("{}. {}: {}", row.meaning, row.placeholder, expectation(number));
}

std::string_view default_of(OptionRow const& row) {
  return row.default_text.empty() ? row.value.blank : row.default_text;
}

constexpr std::size_t indent = 37;
constexpr std::size_t width = 100;

std::string wrapped(std::string const& text) {
  std::string lines;
  std::size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column + word.size() >= width) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    }
    lines += (column > indent ? " " : "") + word;
    column += word.size() + (column > indent ? 1 : 0);
  }
  return lines;
}

}  // namespace

std::string OptionRow::syntax() const {
  std::vector<std::string_view> parts(value.words.begin(), value.words.end());
  if (!placeholder.empty()) {
    parts.insert(value.kind == FieldKind::text ? parts.begin() : parts.end(), placeholder);
  }
  auto const values = fmt::format("{}", fmt::join(parts, "|"));
  if (bare.empty()) return fmt::format("{} {}", flag(), values);
  // A plain switch is shown without its words.
  return value.words.size() > 2 ? fmt::format("{}[={}]", flag(), values) : flag();
}

std::string OptionRow::expectation() const {
  if (is_number(value) || value.kind == FieldKind::choice) {
    return gpu_shading::energyplus::expectation(value);
  }
  return fmt::format("{}{}", placeholder == "DIR" ? "a folder" : "a file",
                     value.words.empty() ? "" : " or off");
}

std::string help_of(OptionRow const& row) {
  auto line = "  " + row.syntax();
  line += line.size() + 2 > indent ? '\n' + std::string(indent, ' ')
                                   : std::string(indent - line.size(), ' ');
  auto const text = fmt::format("{} (default: {})", meaning_of(row), default_of(row));
  return line + wrapped(replaced(text, "`", "")) + '\n';
}

std::string options_help(bool all) {
  std::string text =
      "GPU shading (each also as an environment variable: GPU_SHADING, GPU_SHADING_RESOLUTION, "
      "...):\n";
  for (auto const& row : option_rows()) {
    if (row.audience <= (all ? Audience::experts : Audience::everyone)) text += help_of(row);
  }
  if (!all) text += "Options for special cases: gpu_shading help options --help-all\n";
  return text;
}

std::string options_table() {
  std::string text = "| flag | environment variable | default | meaning |\n|---|---|---|---|\n";
  for (auto const& row : option_rows()) {
    if (row.audience > Audience::experts) continue;
    text += fmt::format("| `{}` | `{}` | {} | {} |\n", replaced(row.syntax(), "|", "\\|"),
                        row.variable(), default_of(row), meaning_of(row));
  }
  return text;
}

}  // namespace gpu_shading::energyplus
