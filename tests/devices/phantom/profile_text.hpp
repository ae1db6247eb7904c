// Texts of wire profiles for tests: the smallest one, and one with lines added or changed.
#pragma once

#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy_test {

inline const std::string minimal_profile =
    "calligraphy wire profile 1\n"
    "name small\n"
    "report 8\n"
    "encoder 1 u16 at 0\n"
    "encoder 2 u16 at 2\n"
    "encoder 3 u16 at 4\n";

inline calligraphy::phantom::WireProfile parsed(const std::string& text) {
  std::istringstream in(text);
  return calligraphy::phantom::read_wire_profile(in, "lab.txt");
}

inline std::string format_error(const std::string& text) {
  try {
    parsed(text);
  } catch (const calligraphy::FormatError& error) {
    return error.what();
  }
  return {};
}

}  // namespace calligraphy_test
