#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace gpu_shading::energyplus {

// With quiet, this process writes no messages but warnings and errors, and no progress.
void set_quiet(bool quiet);
bool is_quiet();

// One line on standard error, "gpu_shading: ...". Warnings and errors begin with that word.
void print_line(std::string const& line);

// Text for standard output, of any number of lines. Names in models and files can hold escape
// sequences of terminals: control characters other than line breaks are escaped.
void print_text(std::string_view text);

// The same, formatted.
template <typename... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace gpu_shading::energyplus
