#pragma once

namespace gpu_shading::gl {

// Checks for GL errors, after each piece of work; no other code does. `doing` completes "while
// ...". Throws DeviceError if the device was lost or ran out of memory, and Error on misuse of GL
// (our bug).
void check(char const* doing);

}  // namespace gpu_shading::gl
