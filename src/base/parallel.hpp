// A parallel loop.
#pragma once

#include <cstddef>
#include <functional>

namespace calligraphy {

/// Calls work(i) once for every i below `count`, from `threads` threads (0: one per core) and in any order. The calling
/// thread takes part and reports the fraction done. An exception from `work` or `progress` ends the loop early; to
/// abort it, throw from `progress`. If several are thrown, the one for the lowest i is rethrown, so the same input
/// always fails with the same message.
void parallel_for(std::size_t count, int threads, const std::function<void(double)>& progress,
                  const std::function<void(std::size_t)>& work);

}  // namespace calligraphy
