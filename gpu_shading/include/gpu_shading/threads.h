#pragma once

namespace gpu_shading {

// From now on no more than `count` threads, the calling one among them, compute in this process at
// a time: a limit for all of oneTBB in it. Throws Error if it is less than 1.
void limit_threads(int count);

}  // namespace gpu_shading
