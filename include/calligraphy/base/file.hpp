// Writing files atomically, and reading regular files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace calligraphy {

/// Writes atomically: to a temporary file beside `path`, which is then renamed. A pipe or a character device, such as
/// /dev/null, is written to directly; a pipe must get a reader within a second. @throws FileError naming the path and
/// the reason; an existing file is then left unchanged
void write_file(const std::filesystem::path& path, std::string_view content);

/// Checks before long work that write_file() can succeed: creates and removes a temporary file beside `path`. Pipes and
/// character devices are not tried: the reader of a pipe would take the attempt for the end of the data.
/// @throws FileError as write_file()
void check_can_write(const std::filesystem::path& path);

/// Opens a regular file for reading. Pipes and devices are rejected: they may block, or never end.
/// @throws FileError naming the path and the reason; FormatError naming a file of more than `max_bytes` bytes
std::ifstream open_file(const std::filesystem::path& path,
                        std::uintmax_t max_bytes = std::numeric_limits<std::uintmax_t>::max());

/// Content of a regular file. @throws as open_file()
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace calligraphy
