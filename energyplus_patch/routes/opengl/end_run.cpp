#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "routes/opengl/opengl_functions.h"

namespace gpu_shading::energyplus {

void end_run(std::exception const& error) {
  if (dynamic_cast<TaskDone const*>(&error) != nullptr) throw TaskDone();
  auto const why = error_line(error);
  print_line("error: " + why);
  fail_drawing(why);
  throw Error("gpu_shading: " + why);
}

}  // namespace gpu_shading::energyplus
