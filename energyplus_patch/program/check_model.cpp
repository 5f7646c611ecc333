#include "program/check_model.h"

#include <fmt/format.h>

#include <cstdio>

namespace gpu_shading::energyplus {

void check(ModelRun const& run, bool vertices) {
  fmt::print("{}", run_task(run, ListingTask{vertices}).text);
}

}  // namespace gpu_shading::energyplus
