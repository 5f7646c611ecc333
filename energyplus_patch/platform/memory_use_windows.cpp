#include "platform/memory_use.h"

namespace gpu_shading::energyplus {

std::string describe_lack_of_memory() { return "out of memory"; }

}  // namespace gpu_shading::energyplus
