#pragma once

namespace gpu_shading::gl {

// The one place where GL errors are asked for, after each piece of work. `doing` completes "while
// ...". Throws DeviceError when the device was lost or ran out of memory, Error on misuse of GL
// (our bug).
void check(char const* doing);

}  // namespace gpu_shading::gl
