#include "program/check_model.h"

#include <fmt/format.h>

#include <cstdio>

namespace gpu_shading::energyplus {

void check(ModelRun const& run, ListingTask const& task) {
  fmt::print("{}", run_task(run, task).text);
}

}  // namespace gpu_shading::energyplus
