#include <windows.h>

#include <cstdio>
#include <cstdlib>

#include "base/error_line.h"
#include "hosted/opengl_answers.h"

namespace gpu_shading::energyplus {

// Exceptions of MinGW do not pass through EnergyPlus, which is compiled by another compiler.
void end_run(std::exception const& error) {
  std::fprintf(stderr, "gpu_shading: error: %s\n", error_line(error).c_str());
  std::fflush(stderr);
  ExitProcess(EXIT_FAILURE);
}

}  // namespace gpu_shading::energyplus
