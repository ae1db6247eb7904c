// Long computations are shorter under sanitizers, which run ten times as long and look for wrong accesses, not figures.
#pragma once

namespace calligraphy_test {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace calligraphy_test
