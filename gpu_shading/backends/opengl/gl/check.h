#pragma once

namespace gpu_shading::gl {

// Checks for GL errors, after each piece of work; no other code does. `doing` completes "while
// ...". Throws DeviceError if the device was lost or ran out of memory, and Error on misuse of GL
// (our bug), which includes the messages of a debug context.
void check(char const* doing);

// Makes the current debug context log errors and undefined behaviour for check(), and nothing else.
void log_misuse();

}  // namespace gpu_shading::gl
