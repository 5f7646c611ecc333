#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// EnergyPlus ignores the case of names; so do these functions.
std::string upper(std::string_view text);
bool same_name(std::string_view a, std::string_view b);

// Whether a name matches a pattern, in which * stands for any characters; case is ignored.
bool matches(std::string_view pattern, std::string_view name);
bool matches_any(std::vector<std::string> const& patterns, std::string_view name);

// The number in a field; empty unless the whole text is a finite number.
std::optional<double> parse_number(std::string const& text);

// The text without surrounding white space.
std::string trimmed(std::string_view text);

// The comma-separated parts of a line, trimmed.
std::vector<std::string> comma_separated(std::string const& line);

// Whether a byte is one of ASCII's control characters.
constexpr bool is_control(unsigned char byte) {
  constexpr unsigned char del = 0x7F;
  return byte < ' ' || byte == del;
}

// For a message: control characters escaped (\\n, \\x1b), long text cut to some 80 characters.
std::string printable(std::string_view text);
std::string in_quotes(std::string_view text);  // the same, in double quotes

// "A, B, C and 4 more", printable.
std::string listed(std::vector<std::string> const& names, std::size_t max);

// For an error or a warning, whatever names and values it quotes: in one line, control characters
// escaped, the middle of a very long one left out.
std::string one_line(std::string_view message);

// Control characters but line breaks escaped.
std::string without_controls(std::string_view text);

// The text as a CSV field in quotes. A spreadsheet would take text that begins with = + - @ for a
// formula: an apostrophe goes before it, unless it is a number.
std::string csv_quoted(std::string_view text);
// The same, in quotes only if necessary.
std::string csv_field(std::string_view text);

// The fields of a line of CSV as they are written, with their quotes.
std::vector<std::string> csv_fields(std::string_view line);
// The text of a field, without its quotes.
std::string csv_text(std::string const& field);

// "; did you mean WORD?" for the word that `text` is most probably a mistyping of: the one that the
// fewest inserted, deleted, replaced or swapped letters make of it. Empty where none is near.
std::string did_you_mean(std::string_view text, std::vector<std::string> const& words);

// The text with what is not UTF-8, as names in IDF files may be, replaced by U+FFFD.
std::string valid_utf8(std::string const& text);

// Text for HTML, XML and SVG, between tags or in double quotes: valid UTF-8, with & < > " as
// entities, and ? for control characters, which XML does not allow.
std::string markup_text(std::string const& text);

}  // namespace gpu_shading::energyplus
