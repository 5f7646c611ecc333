#pragma once

namespace gpu_shading::energyplus {

// Whether this thread has decoded a restricted file since the last call in a process that could
// read all other files of the user, because the kernel refuses landlock.
bool take_unconfined_decoding();

}  // namespace gpu_shading::energyplus
