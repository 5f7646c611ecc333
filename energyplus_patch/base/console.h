#pragma once

#include <string>

namespace gpu_shading::energyplus {

// With quiet, this process writes no messages but warnings and errors, and no progress.
void set_quiet(bool quiet);
bool is_quiet();

// One line on standard error, "gpu_shading: ...". Warnings and errors begin with that word.
void print_line(std::string const& line);

}  // namespace gpu_shading::energyplus
