// Work on every core.
#pragma once

#include <cstddef>
#include <functional>

namespace calligraphy {

/// Calls work(i) once for every i below `count`, from `threads` threads (0: one per core) and in any order. The calling
/// thread works too and reports the share that is done. What work or progress throws ends it all early: a program
/// that gives up throws from `progress`. Of several failures the one of the lowest i is thrown on, so that the same
/// input fails with the same words.
void parallel_for(std::size_t count, int threads, const std::function<void(double)>& progress,
                  const std::function<void(std::size_t)>& work);

}  // namespace calligraphy
