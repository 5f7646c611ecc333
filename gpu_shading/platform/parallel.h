#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace gpu_shading {

// Whether this process was forked from one that had already used threads here. Threads are not
// copied to such a process, so that TBB would wait for them for ever.
bool lacks_threads();

// How many threads for_each_index uses: the cores that this process may use, unless limit_threads()
// allows fewer.
int available_threads();

// Calls use(i) for every i below `count`, on available_threads().
template <typename Use>
void for_each_index(std::size_t count, Use const& use) {
  if (!lacks_threads()) {
    tbb::parallel_for(std::size_t{0}, count, use);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) use(i);
}

}  // namespace gpu_shading
