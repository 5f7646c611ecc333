#include <windows.h>

#include <cstdio>
#include <cstdlib>

#include "platform/error_line.h"
#include "routes/opengl/opengl_functions.h"

namespace gpu_shading::energyplus {

// Exceptions of MinGW do not pass through EnergyPlus, which is compiled by another compiler.
void end_run(std::exception const& error) {
  if (dynamic_cast<TaskDone const*>(&error) != nullptr) ExitProcess(EXIT_SUCCESS);
  auto const why = error_line(error);
  std::fprintf(stderr, "gpu_shading: error: %s\n", why.c_str());
  fail_drawing(why);
  std::fflush(stderr);
  ExitProcess(EXIT_FAILURE);
}

}  // namespace gpu_shading::energyplus
