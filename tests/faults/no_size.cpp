// Preloaded into EnergyPlus: the sizes of its objects are not known, so that nothing is found in
// them.

#include <malloc.h>

#include <cstddef>

extern "C" std::size_t malloc_usable_size(void* /*block*/) noexcept { return 0; }
