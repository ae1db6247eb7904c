// Opens a pipe or a character device without waiting for ever.
#pragma once

#include <cstdio>
#include <string>

namespace calligraphy {

/// For writing; null, with the reason in `errno`, if it cannot be opened: ENXIO for a pipe that no program reads, after
/// a second in which its reader may start.
std::FILE* open_stream(const std::string& path) noexcept;

}  // namespace calligraphy
