// Stroke letters: what kind each stroke of a character is, as the npm package cnchar-order says.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace calligraphy {

/// A letter per stroke, in writing order.
using StrokeLetters = std::unordered_map<char32_t, std::string>;

/// Finds the table of letters in the text of cnchar.order.min.js; no JavaScript is run. `name` is used in messages.
/// @throws FormatError naming the place
StrokeLetters parse_stroke_letters(std::string_view javascript, const std::string& name);

/// Reads it from the package: its tarball, its directory or its cnchar.order.min.js alone.
/// @throws FileError when that cannot be read or holds no such file, FormatError as above
StrokeLetters read_stroke_letters(const std::filesystem::path& source);

}  // namespace calligraphy
