// npm packages that tests read; an environment variable names each.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "catch.hpp"

namespace calligraphy {

/// The path, or an empty one with the reason printed; a test failure where the data is required.
inline std::filesystem::path package_data(const std::string& variable) {
  const char* const path = std::getenv(variable.c_str());
  if (path != nullptr && *path != '\0') return path;
  if (std::getenv("CALLIGRAPHY_REQUIRE_DATA") != nullptr) FAIL(variable + " is not set");
  WARN("skipped: " + variable + " is not set");
  return {};
}

}  // namespace calligraphy
