// Opens a pipe or a character device without waiting forever.
#pragma once

#include <cstdio>
#include <string>

namespace calligraphy {

/// Opens for writing. Returns null, with the reason in `errno`, on failure: ENXIO for a pipe that no program reads,
/// after waiting a second for a reader to start.
std::FILE* open_stream(const std::string& path) noexcept;

}  // namespace calligraphy
