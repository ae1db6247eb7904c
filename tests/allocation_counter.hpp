// Counts what the program takes from the heap by operator new, so that a test can say that a call takes nothing.
#pragma once

#include <cstddef>

namespace calligraphy_test {

/// Calls of any form of the global operator new so far, in all threads.
std::size_t allocations();

}  // namespace calligraphy_test
