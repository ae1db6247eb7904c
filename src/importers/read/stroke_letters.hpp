// Stroke letters: the kind of each stroke of a character, from the npm package cnchar-order.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace calligraphy {

/// One letter per stroke, in writing order, for each character.
using StrokeLetters = std::unordered_map<char32_t, std::string>;

/// Extracts the letters from the text of cnchar.order.min.js, without running JavaScript. `name` is used in messages.
/// @throws FormatError naming the place
StrokeLetters parse_stroke_letters(std::string_view javascript, const std::string& name);

/// Reads the letters from the package: its tarball, its directory or only its cnchar.order.min.js.
/// @throws FileError if it cannot be read or has no such file, FormatError as above
StrokeLetters read_stroke_letters(const std::filesystem::path& source);

}  // namespace calligraphy
