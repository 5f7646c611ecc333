#pragma once

#include <exception>
#include <string>

namespace gpu_shading::energyplus {

// What an exception says, in one line (see one_line()). Where memory has run out: how much is in
// use and how much may be.
std::string error_line(std::exception const& error);

}  // namespace gpu_shading::energyplus
