// What `calligraphy import` found: as tables for a person, as JSON for a program.
#pragma once

#include <string>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy::tools {

/// Where the characters went.
struct ImportOutput {
  std::string file;
  std::string format;
  std::size_t bytes = 0;
};

std::string tables(const Import& import, const ImportOutput& output);

std::string json(const Import& import, const ImportOutput& output);

/// "obeyed", "overruled", "unknown".
const char* name_of(LabelFate fate) noexcept;

/// "永 (U+6C38)", with the order's name where it is not the standard one.
std::string name_of(char32_t code, const std::string& order);

}  // namespace calligraphy::tools
