// Files that are whole or not there.
#pragma once

#include <filesystem>
#include <string_view>

namespace calligraphy {

/// Writes to a temporary file beside `path`, then renames it.
/// @throws FileError naming the path and the reason; a file that was there before is left as it was
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace calligraphy
