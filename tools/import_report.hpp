// Report of `calligraphy import`, as tables and as JSON.
#pragma once

#include <string>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy::tools {

/// The file that was written.
struct ImportOutput {
  std::string file;
  std::string format;
  std::size_t bytes = 0;
};

std::string tables(const ImportResult& import, const ImportOutput& output);

std::string json(const ImportResult& import, const ImportOutput& output);

/// "永 (U+6C38)", followed by the name of the stroke order unless it is the standard one.
std::string character_label(char32_t code, const std::string& order);

}  // namespace calligraphy::tools
