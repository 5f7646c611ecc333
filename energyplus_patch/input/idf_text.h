#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// One object of an IDF and where it stands in the text.
struct IdfObject {
  std::string type;                 // as written
  std::vector<std::string> fields;  // as written, without surrounding blanks and comments
  std::size_t begin = 0;            // offset of the type's first character
  std::size_t end = 0;              // offset past the closing semicolon
};

// Every object of an IDF, in order. The syntax is EnergyPlus's own: commas between fields, a
// semicolon at the end, comments from ! to the end of the line. An object that the text ends in the
// middle of is left out: EnergyPlus itself complains about it.
std::vector<IdfObject> parse_idf(std::string_view text);

// The text of an object, one field a line.
std::string format_idf(std::string_view type, std::vector<std::string> const& fields);

}  // namespace gpu_shading::energyplus
