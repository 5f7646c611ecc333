#pragma once

#include "options/options.h"

namespace gpu_shading::energyplus {

// What a host hands over, flags one a line or separated by blanks (nullptr: none), over the
// environment. Throws Error.
Choices given_choices(char const* flags);

}  // namespace gpu_shading::energyplus
