// The numbers of the judge by name, so that the program can vary them.
#pragma once

#include <string>

namespace calligraphy_test {

/// Sets one of the judge's constants, "NAME=VALUE". Before anything is judged: what judges reads them unguarded.
/// @throws ValueError for a name that there is not, with those that there are, and for what is no finite number
void set_constant(const std::string& assignment);

}  // namespace calligraphy_test
