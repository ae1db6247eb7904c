// The row of a table with a name.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>

namespace calligraphy_test {

/// @throws calligraphy::ValueError for an unknown name, listing all
template <typename Row>
const Row& row_named(const std::vector<Row>& rows, const std::string& name) {
  std::string names;
  for (const Row& each : rows) {
    if (each.name == name) return each;
    names += " " + each.name;
  }
  throw calligraphy::ValueError("--row " + name + ": expected one of" + names);
}

}  // namespace calligraphy_test
