#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Starts decoding a file, from `input` to `output`, in a process of its own, a child of this one,
// whose number is returned. `program` is one beside this module or program; it is started once for
// each thread (decoding/server.h). Throws Error with the reason in one line.
pid_t start_decoding(char const* program, std::vector<std::string> const& words, int input,
                     int output);

}  // namespace gpu_shading::energyplus
