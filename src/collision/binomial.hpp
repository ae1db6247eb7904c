// Binomial coefficients up to the degree of the slope of a quartic's squared distance.
#pragma once

#include <array>

namespace calligraphy {

inline constexpr std::array<std::array<double, 8>, 8> binomial = {{{1},
                                                                   {1, 1},
                                                                   {1, 2, 1},
                                                                   {1, 3, 3, 1},
                                                                   {1, 4, 6, 4, 1},
                                                                   {1, 5, 10, 10, 5, 1},
                                                                   {1, 6, 15, 20, 15, 6, 1},
                                                                   {1, 7, 21, 35, 35, 21, 7, 1}}};

}  // namespace calligraphy
