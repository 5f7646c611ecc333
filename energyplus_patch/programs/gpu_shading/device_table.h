#pragma once

namespace gpu_shading::energyplus {

void list_devices();

// Tests each device, and the CPU, on cases of known answers, and prints errors and times side by
// side, and a verdict on each. Returns whether all are right.
bool test_devices();

}  // namespace gpu_shading::energyplus
