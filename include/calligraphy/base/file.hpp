// Files that are whole or not there, and those that are read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace calligraphy {

/// Writes to a temporary file beside `path`, then renames it.
/// @throws FileError naming the path and the reason; a file that was there before is left as it was
void write_file(const std::filesystem::path& path, std::string_view content);

/// Tells before long work that write_file would fail: makes a temporary file beside `path` and removes it.
/// @throws FileError as write_file does
void check_can_write(const std::filesystem::path& path);

/// A regular file to read from: a pipe might never say a word, and a device never end.
/// @throws FileError naming the path and the reason
std::ifstream open_file(const std::filesystem::path& path);

/// All that a regular file holds. @throws FileError as open_file does; FormatError naming a file of more than `most`
/// bytes
std::string read_file(const std::filesystem::path& path, std::size_t most);

}  // namespace calligraphy
