// Counts heap allocations by operator new, so that a test can assert that a call does not allocate.
#pragma once

#include <cstddef>

namespace calligraphy_test {

/// Calls of any form of the global operator new so far, in all threads.
std::size_t allocations();

}  // namespace calligraphy_test
