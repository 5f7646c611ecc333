#pragma once

#include <cstdio>
#include <exception>

namespace gpu_shading {

// Body of a benchmark's main(): prints its table, or one line that says why it cannot.
template <typename PrintTable>
int print_or_say_why(char const* bench, PrintTable print_table) {
  try {
    print_table();
    return 0;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "%s: %s\n", bench, error.what());
    return 1;
  }
}

}  // namespace gpu_shading
