#include "base/console.h"
#include "base/error_line.h"
#include "gpu_shading/error.h"
#include "hosted/opengl_answers.h"

namespace gpu_shading::energyplus {

void end_run(std::exception const& error) {
  if (dynamic_cast<TaskDone const*>(&error) != nullptr) throw TaskDone();
  auto const why = error_line(error);
  print_line("error: " + why);
  fail_task(why);
  throw Error("gpu_shading: " + why);
}

}  // namespace gpu_shading::energyplus
