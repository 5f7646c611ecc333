#include "programs/gpu_shading/check_model.h"

#include "platform/console.h"

namespace gpu_shading::energyplus {

void check(ModelRun const& run, ListingTask const& task) { print_text(run_task(run, task).text); }

}  // namespace gpu_shading::energyplus
