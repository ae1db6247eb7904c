// Values that no measurement has, which tests give to everything.
#pragma once

#include <limits>

namespace calligraphy_test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace calligraphy_test
