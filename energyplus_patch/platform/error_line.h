#pragma once

#include <exception>
#include <string>

namespace gpu_shading::energyplus {

// What an exception says, in one line (see one_line()). For a call of the file system: the file,
// and why it failed. Where memory has run out: how much is in use and how much may be.
std::string error_line(std::exception const& error);

// For main() to call. Memory can run out where no exception may leave, as in destructors of
// libraries: the program then ends with the line of that error and EXIT_FAILURE, and does not
// crash. Other exceptions that nobody catches end it as before.
void catch_lack_of_memory();

}  // namespace gpu_shading::energyplus
