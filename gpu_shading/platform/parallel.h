#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
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

// The same for calls that may be short: this thread makes those that end before others would have
// woken, which would then spin for as long again.
template <typename Use>
void for_each_short(std::size_t count, Use const& use) {
  constexpr std::chrono::microseconds worth_waking{1000};
  constexpr std::size_t most_between = 16;  // looks at the clock, which cost as much as some calls
  auto const began = std::chrono::steady_clock::now();
  std::size_t first = 0;
  for (std::size_t next = 1; first < count; next = std::min(2 * next, first + most_between)) {
    while (first < std::min(next, count)) use(first++);
    if (std::chrono::steady_clock::now() - began > worth_waking) break;
  }
  for_each_index(count - first, [&](std::size_t i) { use(first + i); });
}

}  // namespace gpu_shading
