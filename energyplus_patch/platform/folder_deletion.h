#pragma once

namespace gpu_shading::energyplus {

// Deletes a folder with all that is in it; links are not followed. Makes only system calls and
// needs one file descriptor, so that it works in a signal handler and where memory or descriptors
// have run out. What others write into it meanwhile is deleted too, within reason. Returns whether
// the folder is gone.
bool delete_folder(char const* path) noexcept;

}  // namespace gpu_shading::energyplus
