#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// Editors on Windows begin UTF-8 text with it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// One object of an IDF and its position in the text.
struct IdfObject {
  std::string type;                 // as written
  std::vector<std::string> fields;  // as written, without surrounding blanks and comments
  std::size_t begin = 0;            // offset of the type's first character
  std::size_t end = 0;              // offset past the closing semicolon
  bool is_closed = true;            // false: the text ends before the semicolon
  // A comma stands between two digits, though others are followed by white space.
  bool has_decimal_comma = false;
};

// All objects of an IDF, in order. The syntax is EnergyPlus's own: commas between fields, a
// semicolon at the end, comments from ! to the end of the line. As in EnergyPlus, the end of the
// text also ends the last object, and a byte order mark is skipped.
std::vector<IdfObject> parse_idf(std::string_view text);

// The text of an object, one field per line.
std::string format_idf(std::string_view type, std::vector<std::string> const& fields);

}  // namespace gpu_shading::energyplus
